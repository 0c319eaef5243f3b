#pragma once
// Reads what a run recorded back into plain vectors, for pictures and reports. A simulation never reads its
// record; so this is liberal: what is not there is left empty. What is there must be whole, and fit together.

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/domain/field.hpp"
#include "core/io/file.hpp"

namespace beadwork::record {

struct FrameHead {
  std::string name;  ///< of the group under /frames
  Real time = 0;
  std::int64_t step = 0;
  bool picture = false;  ///< the watcher asked for a picture of this frame
  std::string view;      ///< axes along which it is to be seen, "z y"; empty: not said
};

/// What is read of columns that hold several numbers a row: of vectors the length, and of others nothing; or all of them.
enum class Columns { drawable, whole };

/// A recorded column besides those that every frame has.
struct FieldValues {
  std::string name, unit;
  std::vector<Real> values;  ///< `width` a row, row by row
  bool is_length = false;    ///< of a vector, whose numbers were left behind
  int width = 1;             ///< 3 of vectors, 4 of quaternions (w x y z), 6 of symmetric tensors (xx xy xz yy yz zz)
};

struct Bonds {
  std::string family;
  std::string law;  ///< attribute "law" of the group, or empty
  std::vector<std::int64_t> id;
  std::vector<std::array<Index, 2>> ends;  ///< rows of the frame's elements
  std::vector<State> state;                ///< as long as ends; all intact where the file has none
  bool has_damage = false;                 ///< the family can soften
  std::vector<FieldValues> fields;         ///< as long as ends each
};

struct Frame {
  FrameHead head;
  std::vector<std::int64_t> id;
  std::vector<Vec3> position;
  std::vector<Real> radius;
  std::vector<Vec3> displacement;   ///< empty, or as long as position
  std::vector<FieldValues> fields;  ///< of the elements, as long as position each
  std::vector<Bonds> bonds;
  std::vector<std::array<Vec3, 2>> walls;  ///< lines that show them
};

/// Every break of the run, in the order in which they were booked. Columns that a file lacks are empty.
struct Breaks {
  std::vector<Real> time;
  std::vector<std::string> mode;
  std::vector<Real> energy;
  std::vector<std::string> family;
  std::vector<std::int64_t> step, bond, element;  ///< element: the one that failed; -1 where a bond broke by itself
  std::vector<Vec3> place;
};

class FrameReader {
 public:
  /// Throws MachineFailure if the file cannot be opened as HDF5.
  explicit FrameReader(const std::filesystem::path& file, SymbolicLinks links = SymbolicLinks::refuse);
  ~FrameReader();
  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;

  const std::vector<FrameHead>& frames() const { return frames_; }  ///< in the order of their steps
  int unreadable_frames() const { return unreadable_; }             ///< links whose target is missing or damaged

  Frame read(const FrameHead&, Columns = Columns::drawable) const;  ///< throws MachineFailure
  Breaks breaks() const;                                            ///< empty where there is none

  /// The texts under /meta by their names: name, resolved, version, packing, ...
  std::map<std::string, std::string> meta() const;
  /// Named sets of element ids: /sets/<name>, empty where there are none.
  std::map<std::string, std::vector<std::int64_t>> sets() const;
  /// Listed neighbours, two ids each: /pairs/<name>, empty where there are none.
  std::map<std::string, std::vector<std::int64_t>> pairs() const;

 private:
  std::map<std::string, std::vector<std::int64_t>> ids_in(const char* group, int width) const;
  struct File;
  std::unique_ptr<File> file_;
  std::vector<FrameHead> frames_;
  int unreadable_ = 0;
};

}  // namespace beadwork::record
