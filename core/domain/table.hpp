#pragma once
// Columns of one length. A column is there because somebody asked for it, and costs nothing otherwise.

#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/domain/view.hpp"

namespace beadwork {

/// Memory of zeros that starts on a cache line; blocks start staggered modulo 4096, since arrays that all start alike
/// evict one another from the cache (measured: a step 2.6 times slower). Pages that nobody has written to take no
/// memory.
class Block {
 public:
  explicit Block(std::size_t bytes);
  std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }

 private:
  struct Free {
    void operator()(std::byte* memory) const { std::free(memory); }
  };
  std::unique_ptr<std::byte, Free> storage_;
  std::byte* data_;
  std::size_t size_;
};

class Column {
 public:
  explicit Column(Field field) : field_(std::move(field)) {}
  const Field& field() const { return field_; }
  bool kept() const { return kept_; }  ///< saved in checkpoints
  void keep() { kept_ = true; }
  bool summed() const { return summed_; }  ///< a sum that families add to, beside those of the forces
  void sum() { summed_ = true; }

  /// Throws std::logic_error if the column holds another type. Of a const column nobody gets more than a look.
  template <class T>
  View<T> view() {
    require(type_of<T>());
    return {base_, stride_, plane_};
  }
  template <class T>
  View<const T> view() const {
    require(type_of<T>());
    return {base_, stride_, plane_};
  }
  std::byte* base() { return base_; }
  const std::byte* base() const { return base_; }
  std::size_t stride() const { return stride_; }
  std::size_t plane() const { return plane_; }

 private:
  friend class Table;
  void require(Type type) const;
  Field field_;
  bool kept_ = false;
  bool summed_ = false;
  std::byte* base_ = nullptr;
  std::size_t stride_ = 0;
  std::size_t plane_ = 0;
};

class Table {
 public:
  /// `rows`: a row's numbers side by side (elements: fetched by random index); `planes`: each component apart (bonds:
  /// streamed in order).
  enum class Layout { rows, planes };

  explicit Table(Layout layout) : layout_(layout) {}
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  /// The column of this name, made if need be. Throws std::logic_error if it exists with another type or unit.
  Column& add(const Field& field);
  Column* find(std::string_view name);
  const Column* find(std::string_view name) const;
  /// As `find`, but throws std::logic_error naming the column when there is none.
  Column& column(std::string_view name);
  const Column& column(std::string_view name) const;
  std::vector<Column*> columns();
  std::vector<const Column*> columns() const;

  Index size() const { return size_; }
  /// Rows beyond `size`, of the columns of `line` only, for sums that are not yet an element's own.
  void resize(Index rows);
  void reserve_beyond(std::string_view line, Index extra);
  /// New row i takes what stood in row order[i], or is zero where that is -1; the length follows.
  void permute(std::span<const Index> order);
  /// As `permute`, for the rows from `begin` on, in place: views stay valid.
  void permute_range(Index begin, std::span<const Index> order);
  std::size_t memory() const;

 private:
  void lay_out(const std::string& line, Index old_size, const Index* order);
  std::vector<std::string> lines() const;

  Layout layout_;
  Index size_ = 0;
  std::vector<std::unique_ptr<Column>> columns_;
  struct Storage {
    std::string line;
    std::unique_ptr<Block> block;
    Index beyond = 0;
  };
  std::vector<Storage> storage_;
  Storage& storage_of(const std::string& line);
};

}  // namespace beadwork
