#include "core/domain/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <new>
#include <stdexcept>
#include <utility>

namespace beadwork {

namespace {

constexpr std::size_t cache_line = 64;
constexpr std::size_t page = 4096;

std::size_t round_up(std::size_t value, std::size_t to) { return (value + to - 1) / to * to; }

// A line of numbers is fetched whole: up to 32 and 64 bytes it should not straddle two cache lines.
std::size_t row_stride(std::size_t width) {
  if (width <= 16) return width;
  if (width <= 32) return 32;
  return round_up(width, cache_line);
}

}  // namespace

Block::Block(std::size_t bytes) : size_(bytes) {
  static std::atomic<std::size_t> count{0};
  const std::size_t stagger = (count++ * 9 * cache_line) % page;  // 9: neighbours in allocation order stay far apart
  storage_.reset(static_cast<std::byte*>(std::calloc(bytes + 2 * page, 1)));
  if (!storage_) throw std::bad_alloc();
  const auto start = reinterpret_cast<std::uintptr_t>(storage_.get());
  data_ = storage_.get() + (round_up(start, page) - start) + stagger;
}

void Column::require(Type type) const {
  if (type != field_.type)
    throw std::logic_error(fmt::format("column '{}' on {} holds a {}, not a {}", field_.name, place_name(field_.on),
                                       type_name(field_.type), type_name(type)));
}

Column& Table::add(const Field& field) {
  if (Column* there = find(field.name)) {
    if (there->field().type != field.type || there->field().unit != field.unit)
      throw std::logic_error(fmt::format("field '{}' on {} is asked for as {} [{}] and as {} [{}]", field.name,
                                         place_name(field.on), type_name(there->field().type), there->field().unit,
                                         type_name(field.type), field.unit));
    return *there;
  }
  columns_.push_back(std::make_unique<Column>(field));
  Column& made = *columns_.back();
  if (made.field_.line.empty()) made.field_.line = field.name;
  storage_of(made.field_.line);
  lay_out(made.field_.line, size_, nullptr);  // neighbours in the line keep their numbers
  return made;
}

const Column* Table::find(std::string_view name) const {
  for (const auto& column : columns_)
    if (column->field().name == name) return column.get();
  return nullptr;
}

const Column& Table::column(std::string_view name) const {
  if (const Column* there = find(name)) return *there;
  throw std::logic_error(fmt::format("no column '{}' in this scene", name));
}

Column* Table::find(std::string_view name) { return const_cast<Column*>(std::as_const(*this).find(name)); }

Column& Table::column(std::string_view name) { return const_cast<Column&>(std::as_const(*this).column(name)); }

std::vector<Column*> Table::columns() {
  std::vector<Column*> all;
  for (const auto& column : columns_) all.push_back(column.get());
  return all;
}

std::vector<const Column*> Table::columns() const {
  std::vector<const Column*> all;
  for (const auto& column : columns_) all.push_back(column.get());
  return all;
}

void Table::resize(Index rows) {
  const Index old = size_;
  size_ = rows;
  for (const std::string& line : lines()) lay_out(line, std::min(old, rows), nullptr);
}

void Table::reserve_beyond(std::string_view line, Index extra) {
  Storage& storage = storage_of(std::string(line));
  if (storage.beyond == extra) return;
  storage.beyond = extra;
  lay_out(storage.line, size_, nullptr);
}

void Table::permute(std::span<const Index> order) {
  size_ = static_cast<Index>(order.size());
  for (const std::string& line : lines()) lay_out(line, size_, order.data());
}

void Table::permute_range(Index begin, std::span<const Index> order) {
  std::vector<std::byte> moved;
  for (const auto& column : columns_) {
    const std::size_t width = component_bytes(column->field().type);
    moved.resize(width * order.size());
    for (std::size_t c = 0; c < static_cast<std::size_t>(components(column->field().type)); ++c) {
      std::byte* plane = column->base_ + c * column->plane_;
      for (std::size_t k = 0; k < order.size(); ++k)
        std::memcpy(moved.data() + k * width, plane + static_cast<std::size_t>(order[k]) * column->stride_, width);
      for (std::size_t k = 0; k < order.size(); ++k)
        std::memcpy(plane + (static_cast<std::size_t>(begin) + k) * column->stride_, moved.data() + k * width, width);
    }
  }
}

std::size_t Table::memory() const {
  std::size_t total = 0;
  for (const Storage& storage : storage_) total += storage.block ? storage.block->size() : 0;
  return total;
}

std::vector<std::string> Table::lines() const {
  std::vector<std::string> names;
  for (const Storage& storage : storage_) names.push_back(storage.line);
  return names;
}

Table::Storage& Table::storage_of(const std::string& line) {
  for (Storage& storage : storage_)
    if (storage.line == line) return storage;
  storage_.push_back({line, nullptr, 0});
  return storage_.back();
}

// Gives the line new memory and moves into it the first `old_size` rows (through `order`, where given).
void Table::lay_out(const std::string& line, Index old_size, const Index* order) {
  Storage& storage = storage_of(line);
  std::vector<Column*> members;
  std::size_t width = 0;
  for (const auto& column : columns_)
    if (column->field().line == line) {
      members.push_back(column.get());
      width += bytes(column->field().type);
    }
  const auto rows = static_cast<std::size_t>(size_) + static_cast<std::size_t>(storage.beyond);
  const bool in_rows = layout_ == Layout::rows;
  const std::size_t stride = row_stride(width);
  const std::size_t size = in_rows ? stride * rows : [&] {
    std::size_t total = 0;
    for (const Column* c : members) {
      const Type type = c->field().type;
      total += static_cast<std::size_t>(components(type)) * round_up(component_bytes(type) * rows, cache_line);
    }
    return total;
  }();
  auto block = std::make_unique<Block>(size);
  std::size_t offset = 0;
  for (Column* column : members) {
    const Type type = column->field().type;
    const Column before = *column;
    column->base_ = block->data() + offset;
    column->stride_ = in_rows ? stride : component_bytes(type);
    column->plane_ = in_rows ? component_bytes(type) : round_up(component_bytes(type) * rows, cache_line);
    offset += in_rows ? bytes(type) : column->plane_ * static_cast<std::size_t>(components(type));
    if (!before.base_) continue;
    for (Index row = 0; row < old_size; ++row) {
      if (order && order[row] < 0) continue;
      const auto from = static_cast<std::size_t>(order ? order[row] : row);
      for (std::size_t c = 0; c < static_cast<std::size_t>(components(type)); ++c)
        std::memcpy(column->base_ + static_cast<std::size_t>(row) * column->stride_ + c * column->plane_,
                    before.base_ + from * before.stride_ + c * before.plane_, component_bytes(type));
    }
  }
  storage.block = std::move(block);
}

}  // namespace beadwork
