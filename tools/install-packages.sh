#!/usr/bin/env bash
# Installs the Debian packages that Beadwork needs, or those that are named, those that are missing only.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config
  libeigen3-dev libboost-dev libtinyxml2-dev libhdf5-dev libudunits2-dev libmuparser-dev libpng-dev libssl-dev
  libmumps-seq-dev libmetis-dev libopenblas0-serial libjs-three
  libcli11-dev libfmt-dev libspdlog-dev nlohmann-json3-dev
  libgtest-dev libgmock-dev libbenchmark-dev
  libxml2-utils python3-h5py python3-meshio
)
[ $# -eq 0 ] || packages=("$@")

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

sudo=()
[ "$(id -u)" -eq 0 ] || sudo=(sudo)
echo "installing: ${missing[*]}"
"${sudo[@]}" apt-get update -qq
DEBIAN_FRONTEND=noninteractive "${sudo[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
