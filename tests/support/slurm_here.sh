# shellcheck shell=bash
# A Slurm of one node in a folder, for tests: without systemd, beside any other that there may be. To be sourced.
#   start_slurm FOLDER MAX_ARRAY_SIZE    sets SLURM_CONF; returns 1 and says why where none can be
#   stop_slurm                           ends its jobs and its daemons

slurm_folder=

# Two ports that nobody listens at.
free_ports() {
  /usr/bin/python3 -c 'import socket
ends = [socket.socket() for _ in range(2)]
for end in ends: end.bind(("127.0.0.1", 0))
print(*(end.getsockname()[1] for end in ends))'
}

write_slurm_conf() { # FOLDER MAX_ARRAY_SIZE
  local node ports
  node=$(hostname -s)
  read -ra ports <<<"$(free_ports)"
  cat >"$1/slurm.conf" <<END
ClusterName=beadwork
SlurmctldHost=$node(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$1/munge.socket,cred_expire=5
SlurmctldPort=${ports[0]}
SlurmdPort=${ports[1]}
StateSaveLocation=$1/state
SlurmdSpoolDir=$1/spool
SlurmctldPidFile=$1/slurmctld.pid
SlurmdPidFile=$1/slurmd.pid
SlurmctldLogFile=$1/slurmctld.log
SlurmdLogFile=$1/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,bf_interval=1
ReturnToService=2
MaxArraySize=$2
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=INFINITE State=UP
END
  # Later ones look for control groups that a container does not have; earlier ones do not know the word.
  local version
  version=$(slurmd -V | grep -o '[0-9][0-9]*\.[0-9][0-9]*')
  if [ "$(printf '%s\n23.11\n' "$version" | sort -V | head -n 1)" = 23.11 ]; then echo CgroupPlugin=disabled >"$1/cgroup.conf"; fi
}

start_slurm() { # FOLDER MAX_ARRAY_SIZE
  PATH=$PATH:/usr/sbin:/sbin
  local program
  for program in munged slurmctld slurmd sbatch squeue scontrol scancel; do
    command -v $program >/dev/null || { echo "there is no $program here (Debian: slurm-wlm, munge)"; return 1; }
  done
  mkdir -p "$1/state" "$1/spool"
  slurm_folder=$1
  write_slurm_conf "$1" "$2"
  export SLURM_CONF=$1/slurm.conf
  (umask 077 && head -c 1024 /dev/urandom >"$1/munge.key")
  munged --force --key-file="$1/munge.key" --socket="$1/munge.socket" --pid-file="$1/munged.pid" \
    --log-file="$1/munged.log" --seed-file="$1/munge.seed" || return 1
  slurmctld -i && slurmd || { tail -n 5 "$1"/*.log; return 1; }
  for _ in $(seq 100); do
    [ "$(sinfo --noheader --format=%t 2>/dev/null)" = idle ] && return 0
    sleep 0.2
  done
  echo "its node does not come up"
  tail -n 5 "$1/slurmctld.log" "$1/slurmd.log"
  return 1
}

stop_slurm() {
  [ -n "$slurm_folder" ] || return 0
  if [ -e "$slurm_folder/slurmctld.pid" ]; then
    scancel --user="$(id -un)" 2>/dev/null || true
    for _ in $(seq 100); do [ -z "$(squeue --noheader 2>/dev/null)" ] && break; sleep 0.1; done
  fi
  local daemon
  for daemon in slurmd slurmctld munged; do
    [ -e "$slurm_folder/$daemon.pid" ] || continue
    local process
    process=$(cat "$slurm_folder/$daemon.pid")
    kill "$process" 2>/dev/null || continue
    for _ in $(seq 100); do kill -0 "$process" 2>/dev/null || break; sleep 0.1; done
    kill -KILL "$process" 2>/dev/null || true
  done
  slurm_folder=
}
