#pragma once
// A curve as a table of comma-separated numbers that any program reads:
//   step [1],time [s],force [N]
//   0,0,0
// Numbers are the shortest that read back to the same bits. Each row reaches the file as it is added.

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/io/file.hpp"

namespace beadwork {

struct CurveColumn {
  std::string name;
  std::string unit = "1";
};

/// How a curve stands when a checkpoint is written.
struct CurveEnd {
  std::uintmax_t length = 0;  ///< of the file, in bytes
  std::string first_line;     ///< names and units of the columns
};

class CurveFile {
 public:
  /// Writes the first line. The step comes first by itself; `columns` follow it.
  static CurveFile fresh(const std::filesystem::path& file, const std::vector<CurveColumn>& columns);
  /// Takes up a curve that `cut` has cut. A file that is not there is begun. DeckFailure if its first line is another
  /// one.
  static CurveFile resume(const std::filesystem::path& file, const std::vector<CurveColumn>& columns);

  /// Throws MachineFailure if the row could not be written; the rows before it then still stand.
  void add(std::int64_t step, std::span<const Real> values);
  /// Waits until the disk has the rows; before a checkpoint, so that it never knows more than the curve.
  void sync();
  /// How the file stands.
  CurveEnd end() const;
  /// Writes a text about the curve beside it: curves/force.csv, curves/force.json.
  void write_sidecar(const std::string& json) const;

 private:
  CurveFile(std::filesystem::path file, const std::vector<CurveColumn>& columns);
  void open();

  std::filesystem::path file_;
  std::string first_line_;
  std::size_t columns_;
  Descriptor descriptor_;
  std::string row_;
};

/// Where a curve is to be cut.
struct CurveCut {
  std::filesystem::path file;
  std::uintmax_t length = 0;
};
/// The cuts that take these curves back to a checkpoint, which knows how each stood, by its name: rows that came later
/// go, be they of its very step, and a last row that a kill has torn. Of a curve that has been cut shorter whole rows
/// stay; of one that the checkpoint does not know the first line. Changes nothing: a resume looks at everything before
/// it cuts anything. MachineFailure if one cannot be read, DeckFailure if it has other columns than it had.
std::vector<CurveCut> cuts_to(const std::map<std::string, CurveEnd>& ends,
                              const std::vector<std::filesystem::path>& files);
void cut(const std::vector<CurveCut>& cuts);
/// What a checkpoint knows of curves and the files no longer have, a sentence each.
std::vector<std::string> lost_rows(const std::map<std::string, CurveEnd>& ends, const std::vector<CurveCut>& cuts);

}  // namespace beadwork
