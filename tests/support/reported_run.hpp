#pragma once
// A small run as it lies on the disk, and its report.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/domain/vocabulary.hpp"
#include "core/io/recorder.hpp"
#include "workbench/report/report.hpp"

namespace beadwork {

namespace fs = std::filesystem;

inline void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

inline std::string read(const fs::path& file) {
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}

/// Two layers of six elements, a cohesive interface between them, one bond of which has broken and one
/// softens.
inline void make_specimen(Domain& domain) {
  domain.add_elements(12);
  const auto position = domain.elements().column("position").view<Vec3>();
  const auto radius = domain.elements().column("radius").view<Real>();
  for (Index i = 0; i < 12; ++i) {
    position.set(i, Vec3(i % 6 * 1e-3, 0, i < 6 ? 0 : 1e-3));
    radius[i] = 0.5e-3;
  }
  domain.sets()["lower"] = {0, 1, 2, 3, 4, 5};
  BondTable& interface = domain.add_family("interface");
  interface.create({{0, 6}, {1, 7}, {2, 8}, {3, 9}, {4, 10}, {5, 11}}, 0);
}

inline void record_frames(const fs::path& folder, Domain& domain) {
  RunFolder run = RunFolder::fresh(folder, false);
  RunMeta meta;
  meta.name = "in the record";
  Recorder recorder = Recorder::fresh(run, meta, domain);
  BondTable& interface = *domain.find_family("interface");
  FrameRequest request;
  request.bonds.push_back({&interface, "cohesive-contact", {}});
  recorder.write({0, 0, 0}, request, domain);
  interface.state()[0] = State::broken;
  interface.state()[1] = State::softening;
  domain.breaks().breaks.push_back({5e-4, 50, 0, 0, domain.breaks().mode("normal"), Vec3(0, 0, 5e-4), 1e-3});
  recorder.write({100, 1e-3, 0}, request, domain);
}

class Report : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("beadwork-report-" + std::to_string(getpid()));
    fs::remove_all(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  void make_run() {
    Domain domain;
    make_specimen(domain);
    record_frames(folder, domain);
    write(folder / "summary.json",
          R"({"name": "small <b>& bold", "status": "done", "exit_reason": "time 1 ms reached",
      "elements": 12, "bonds": {"interface": 6}, "steps": 100, "time_step": 1e-5, "wall_seconds": 83,
      "bond_updates_per_second": 21.5e6, "breaks": {"normal": 1}, "something_new": 4.25,
      "utilisation": {"fail.bond-stress": {"of": "interface", "mode": "axial-bending", "largest": 0.8731, "step": 80, "time": 8e-4,
                      "bond": 3, "elements": [3, 9], "place": [0.003, 0, 0.0005]},
                      "fail.bond-stress.2": {"of": "<i>", "mode": "axial", "largest": 0},
                      "fail.virial-stress": {"of": "resin glue", "mode": "virial-hydrostatic", "largest": 1.038, "step": 90,
                      "time": 9e-4, "element": 4, "place": [0.004, 0, 0]}},
      "packing": [{"density": 0.615, "radius_histogram": {"edges": [1e-4, 2e-4, 3e-4], "counts": [7, 5]}}]})");
    write(folder / "resolved.xml", "<scene name=\"small\"><fill/></scene><script>alert(1)</script>");
    write(folder / "run.log", "first line\nlast line\n");
    write(folder / "curves/force.csv",
          "step [1],time [s],displacement [m],force [N],reference Eq (10) [N]\n"
          "0,0,0,0,0\n50,5e-4,1e-4,30,31\n100,1e-3,2e-4,60,59\n");
    write(folder / "curves/force.json", R"({"title": "Load", "x": "displacement", "y": ["force"]})");
    write(folder / "curves/energy.csv",
          "step [1],time [s],external work [J],elastic [J],kinetic [J]\n0,0,0,0,0\n100,1e-3,2,1.5,0.48\n");
  }

  std::string page() { return read(write_report(folder)); }

  fs::path folder;
};

}  // namespace beadwork
