#pragma once
// What this part needs of HDF5: whole datasets, text, attributes, columns; failures in HDF5's own words.
// Included by core/io only.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/domain/table.hpp"
#include "core/io/file.hpp"
#include "core/io/h5_handle.hpp"

namespace beadwork::h5 {

/// The innermost cause on HDF5's error stack; where the system refused, the system's words alone.
std::string reason();
/// Takes over an identifier, or throws MachineFailure "HDF5 cannot <doing>: <reason>".
Handle take(hid_t id, Handle::Close close, const std::string& doing);
void check(herr_t status, const std::string& doing);

/// Makes a file anew, in the format since HDF5 1.8, in which every piece of structure has a check sum: what a disk has
/// damaged is then an error. In the older one the library follows it, and may not survive that.
Handle make_file(const std::string& name, hid_t access);

/// A file that is made in memory, so that the disk sees one plain write whose errors are the system's own. (A file
/// that HDF5 itself could not finish stays open in the library, holding its space, until the program ends.)
class MemoryFile {
 public:
  MemoryFile();
  hid_t id() const { return file_.id(); }
  /// The bytes of the file as they stand; valid until the next write.
  std::span<const std::byte> image() const;

 private:
  Handle file_;
};

Handle make_group(hid_t place, const std::string& name);

struct Label {
  std::string unit = "1";
  std::string long_name;
};

void set_attribute(hid_t object, const std::string& name, const std::string& text);
void set_attribute(hid_t object, const std::string& name, Real value);
void set_attribute(hid_t object, const std::string& name, std::int64_t value);

/// One text, or a list of them: scalar or one-dimensional datasets of UTF-8.
void write_text(hid_t place, const std::string& name, const std::string& text);
void write_texts(hid_t place, const std::string& name, const std::vector<std::string>& texts);
void set_texts_attribute(hid_t object, const std::string& name, const std::vector<std::string>& texts);

/// `rows` times `width` numbers, row by row; one-dimensional if the width is one.
Handle write_reals(hid_t place, const std::string& name, std::span<const Real> numbers, int width, const Label& label);
Handle write_indices(hid_t place, const std::string& name, std::span<const Index> numbers, int width,
                     const Label& label);
Handle write_integers(hid_t place, const std::string& name, std::span<const std::int64_t> numbers, const Label& label);

/// A column under its own name, with unit and long_name, and with what is needed to make it again.
void write_column(hid_t place, const Column& column, Index rows);
// ---- Reading (h5_read.cpp). A file may be damaged, or made by somebody who means harm: class, shape and size of
// whatever is read are compared with what the reader wants and with what the file can hold before a byte is taken. What
// lies outside of the file (links, raw data in other files, virtual datasets) is never followed. MachineFailure says
// what does not fit.

Handle open_file(const std::filesystem::path& file, SymbolicLinks links = SymbolicLinks::refuse);
/// A group of this file, by a path of names.
Handle open_group(hid_t place, const std::string& path);
bool has(hid_t place, const std::string& name);
std::vector<std::string> names_in(hid_t group);
/// Whether the name is that of a link into another file, and where to: a file beside this one, and a group in it.
struct Elsewhere {
  std::string file, group;
};
std::optional<Elsewhere> leads_elsewhere(hid_t place, const std::string& name);

/// Shape and kind of a dataset.
struct Shape {
  std::vector<hsize_t> extent;
  bool integer = false;
  bool text = false;
  std::size_t bytes = 0;  ///< of one number
};
Shape shape_of(hid_t place, const std::string& name);
/// The unit of a dataset, empty where it says none.
std::string unit_of(hid_t place, const std::string& name);

bool has_attribute(hid_t object, const std::string& name);
std::string text_attribute(hid_t object, const std::string& name);
std::vector<std::string> texts_attribute(hid_t object, const std::string& name);
Real real_attribute(hid_t object, const std::string& name);
std::int64_t integer_attribute(hid_t object, const std::string& name);
/// The texts in the attribute "names" of a dataset, which its numbers stand for; empty where it has none.
std::vector<std::string> names_of(hid_t place, const std::string& name);

std::string read_text(hid_t place, const std::string& name);
std::vector<std::string> read_texts(hid_t place, const std::string& name);
/// Rows of `width` numbers, row by row; one-dimensional if the width is one.
std::vector<Real> read_reals(hid_t place, const std::string& name, int width = 1);
std::vector<Index> read_indices(hid_t place, const std::string& name, int width = 1);
std::vector<std::int64_t> read_integers(hid_t place, const std::string& name);

/// The field as which a dataset was written.
Field read_field(hid_t place, const std::string& name, On on);
/// Fills the rows of the column from the dataset of its name, which must have as many.
void read_column(hid_t place, Column& column, Index rows);

}  // namespace beadwork::h5
