#include "core/io/packing_text.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "core/base/complaints.hpp"
#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/file.hpp"

namespace beadwork {

namespace {

/// A piece of a line, and where it begins in the file.
struct Cell {
  std::string_view text;
  std::size_t offset;
};

std::shared_ptr<const Source> source_of(const std::filesystem::path& file) {
  open_regular(file, O_RDONLY, "read", SymbolicLinks::follow);  // a pipe would be waited for
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw MachineFailure(fmt::format("cannot read \"{}\": {}", file.string(), std::strerror(errno)));
  auto source = std::make_shared<Source>(Source{file.string(), {std::istreambuf_iterator<char>(stream), {}}});
  if (source->text.starts_with(byte_order_mark)) source->text.erase(0, byte_order_mark.size());
  return source;
}

/// The text while it is read, line by line.
class PackingTable {
 public:
  PackingTable(const std::filesystem::path& file, const TextForm& form) : source_(source_of(file)), form_(form) {}

  StoredPacking read(const Pause& pause) {
    const std::string_view text = source_->text;
    for (std::size_t begin = 0; begin < text.size(); ++line_) {
      if (line_ % 4096 == 1) pause();
      begin_ = begin;
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      take(text.substr(begin, end - begin));
      begin = end + 1;
    }
    warn_of_twins();
    return std::move(packing_);
  }

 private:
  // The line that is read now, from 1, and where it begins.
  int line_ = 1;
  std::size_t begin_ = 0;
  std::shared_ptr<const Source> source_;
  const TextForm& form_;
  std::vector<Heading> columns_;
  std::vector<Real> scale_;  // of each column
  int named_at_ = 0;         // line that named the columns; 0 where none did
  bool settled_ = false;     // an element, or the line of names, has been met
  StoredPacking packing_;
  std::vector<int> line_of_;

  Location at(std::size_t offset) const {
    const std::string_view before = std::string_view(source_->text).substr(begin_, offset - begin_);
    const auto characters = std::count_if(before.begin(), before.end(),
                                          [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
    return {source_, line_, static_cast<int>(characters) + 1, offset};
  }

  // Blanks separate where nothing else does; in a line of names units in brackets belong to the name in front.
  std::vector<Cell> cells(std::string_view line, std::size_t offset, bool names) const {
    const char separator = line.find(';') != line.npos             ? ';'
                           : line.find(',') != line.npos           ? ','
                           : names && line.find('\t') != line.npos ? '\t'
                                                                   : ' ';
    std::vector<Cell> found;
    const auto add = [&](std::string_view piece) {
      const std::string_view text = trim(piece);
      found.push_back({text, offset + static_cast<std::size_t>((text.empty() ? piece : text).data() - line.data())});
    };
    if (separator != ' ') {
      for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(separator, begin), line.size());
        add(line.substr(begin, end - begin));
        begin = end + 1;
      }
      return found;
    }
    constexpr std::string_view blanks = " \t\r\f\v";
    for (std::size_t begin = line.find_first_not_of(blanks); begin < line.size();) {
      const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
      const bool unit = names && !found.empty() && std::string_view("[({").find(line[begin]) != std::string_view::npos;
      if (unit)
        found.back().text = {found.back().text.data(),
                             static_cast<std::size_t>(line.data() + end - found.back().text.data())};
      else
        add(line.substr(begin, end - begin));
      begin = line.find_first_not_of(blanks, end);
    }
    return found;
  }

  void take(std::string_view line) {
    const std::string_view text = trim(line);
    if (text.empty()) return;
    const std::size_t offset = begin_ + static_cast<std::size_t>(text.data() - line.data());
    if (text.front() == '#') {
      if (!settled_) take_remark(text.substr(1), offset + 1);
      return;
    }
    if (!settled_) {
      settled_ = true;
      const auto words = cells(text, offset, true);
      const bool names = std::none_of(words.begin(), words.end(),
                                      [](const Cell& cell) { return parse_number(cell.text).has_value(); });
      const bool decimal_commas =
          text.find_first_of("0123456789") != text.npos && text.find_first_not_of("0123456789+-.,;eE \t") == text.npos;
      if (names && !decimal_commas) return take_names(words);
      if (columns_.empty()) settle_columns(form_.columns.empty() ? usual_columns() : named_by_deck(), nullptr);
    }
    take_element(text, offset);
  }

  // numpy and others put the names of the columns into a remark.
  void take_remark(std::string_view text, std::size_t offset) {
    if (!form_.columns.empty()) return;
    auto words = cells(text, offset, true);
    while (!words.empty() && words.front().text.ends_with(':')) words.erase(words.begin());  // "columns: x y z radius"
    unsigned places = 0;
    bool size = false;
    for (const Cell& word : words) {
      const Holds holds = holds_of(word);
      if (holds <= Holds::z) places |= 1u << static_cast<unsigned>(holds);
      size = size || holds == Holds::radius || holds == Holds::diameter;
    }
    if (places == 7 && size) take_names(words);
  }

  static Holds holds_of(const Cell& word) {
    try {
      return heading_of(word.text).holds;
    } catch (const std::invalid_argument&) {
      return Holds::other;
    }
  }

  void take_names(const std::vector<Cell>& words) {
    std::vector<Heading> headings;
    for (const Cell& word : words) {
      try {
        headings.push_back(heading_of(word.text));
      } catch (const std::invalid_argument& wrong) {
        refuse(at(word.offset), wrong.what());
      }
    }
    named_at_ = line_;
    settle_columns(form_.columns.empty() ? headings : agreed(headings, words), &words);
  }

  std::vector<Heading> named_by_deck() const {
    std::vector<Heading> headings;
    for (const std::string& column : form_.columns)
      headings.push_back(column == "-" ? Heading{Holds::other, "-"} : heading_of(column));
    return headings;
  }

  // The deck says what the columns hold; a text that says otherwise of one is not what was meant.
  std::vector<Heading> agreed(const std::vector<Heading>& text, const std::vector<Cell>& words) const {
    std::vector<Heading> deck = named_by_deck();
    if (deck.size() != text.size())
      refuse(at(words.front().offset),
             fmt::format("here are {} names of columns, 'columns' in the deck has {}", text.size(), deck.size()));
    for (std::size_t k = 0; k < deck.size(); ++k) {
      if (text[k].holds != Holds::other && deck[k].name != "-" && text[k].holds != deck[k].holds)
        refuse(at(words[k].offset),
               fmt::format("this column is called \"{}\" here, and \"{}\" by 'columns' in the deck", text[k].name,
                           deck[k].name));
      if (!deck[k].unit && text[k].holds == deck[k].holds)
        std::tie(deck[k].unit, deck[k].unit_name) = std::tie(text[k].unit, text[k].unit_name);
    }
    return deck;
  }

  void settle_columns(std::vector<Heading> columns, const std::vector<Cell>* words) {
    const auto place = [&](std::size_t k) {
      return at(words ? (*words)[std::min(k, words->size() - 1)].offset : begin_);
    };
    if (const std::string why = why_no_element(columns); !why.empty())
      refuse(place(0), why + ": name them here, or by columns=\"x y z radius\" in the deck, in their order");
    const bool any = std::any_of(columns.begin(), columns.end(), [](const Heading& h) { return h.unit.has_value(); });
    std::vector<std::string> others;
    scale_.clear();
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const Heading& heading = columns[k];
      const bool length = heading.holds < Holds::set;
      if (length && !heading.unit && any && form_.unit.empty())
        refuse(place(k), fmt::format("column '{}' has no unit, others have one: write {} [mm], or whichever it is",
                                     heading.name, heading.name));
      if (length && heading.unit && !form_.unit.empty() && heading.unit->scale != find_unit(form_.unit)->scale)
        refuse(
            place(k),
            fmt::format(
                "column '{}' is in {}, but the deck says unit=\"{}\": leave out 'unit', or mend the one that is wrong",
                heading.name, heading.unit_name, form_.unit));
      if (heading.holds == Holds::other && heading.name != "-") others.push_back("'" + heading.name + "'");
      const Unit unit = heading.unit ? *heading.unit : *find_unit(form_.unit.empty() ? "m" : form_.unit);
      scale_.push_back(unit.scale * (heading.holds == Holds::diameter ? 0.5 : 1));
    }
    if (!others.empty())
      packing_.warnings.push_back(fmt::format("{}: not read: column {}", place(0).where(), join(others)));
    columns_ = std::move(columns);
  }

  void take_element(std::string_view text, std::size_t offset) {
    const auto words = cells(text, offset, false);
    if (words.size() != columns_.size()) refuse_length(text, offset, words.size());
    Vec3 x = zero<Vec3>();
    Real radius = 0;
    for (std::size_t k = 0; k < words.size(); ++k) {
      const Holds holds = columns_[k].holds;
      if (holds == Holds::set) add_to_set(words[k]);
      if (holds >= Holds::set) continue;
      const Real value = number(words[k]) * scale_[k];
      if (holds <= Holds::z)
        x[static_cast<int>(holds)] = value;
      else if (radius = value; !(radius > 0))
        refuse(at(words[k].offset), fmt::format("a {} must be > 0, got \"{}\"",
                                                holds == Holds::radius ? "radius" : "diameter", words[k].text));
    }
    packing_.position.push_back(x);
    packing_.radius.push_back(radius);
    line_of_.push_back(line_);
  }

  void add_to_set(const Cell& cell) {
    std::string_view name = cell.text;
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    if (!name.empty()) packing_.sets[std::string(name)].push_back(packing_.position.size());
  }

  Real number(const Cell& cell) const {
    const auto value = parse_number(cell.text);
    if (value) return *value;
    std::string point(cell.text);
    std::replace(point.begin(), point.end(), ',', '.');
    refuse(at(cell.offset), fmt::format("a line holds {}, got \"{}\"{}", wanted(), cell.text,
                                        parse_number(point) ? fmt::format("; a decimal has a point: {}", point) : ""));
  }

  [[noreturn]] void refuse_length(std::string_view text, std::size_t offset, std::size_t found) const {
    const bool by_blanks =
        text.find(',') != text.npos && text.find_first_of(" \t") != text.npos && text.find(';') == text.npos;
    refuse(at(offset),
           fmt::format(
               "a line holds {}, here are {}{}{}", wanted(), found,
               by_blanks ? "; a decimal has a point, where a comma stands between numbers" : "",
               named_at_ == 0 ? "; other columns are named in a first line, or by columns=\"...\" in the deck" : ""));
  }

  std::string wanted() const {
    std::vector<std::string> names;
    for (const Heading& heading : columns_) names.push_back(heading.name);
    const std::string where = named_at_ ? fmt::format(" (as line {} names them)", named_at_) : "";
    return fmt::format("{} {}, {}{}", columns_.size(), columns_.size() == 4 ? "numbers" : "columns", join(names, " "),
                       where);
  }

  // A line that was copied twice: two elements in one place, whose bond has no length.
  void warn_of_twins() {
    std::vector<std::size_t> order(packing_.position.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto key = [&](std::size_t k) {
      return std::tuple(packing_.position[k][0], packing_.position[k][1], packing_.position[k][2], k);
    };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    std::size_t twins = 0, first = 0;
    for (std::size_t k = 1; k < order.size(); ++k)
      if (packing_.position[order[k]] == packing_.position[order[k - 1]] && twins++ == 0) first = k;
    if (twins == 0) return;
    packing_.warnings.push_back(
        fmt::format("{}:{}: the element of line {} has the same place{}", source_->path, line_of_[order[first]],
                    line_of_[order[first - 1]],
                    twins > 1 ? fmt::format("; {} elements in all stand where another does", twins) : ""));
  }
};

}  // namespace

StoredPacking read_packing_text(const std::filesystem::path& file, const TextForm& form, const Pause& pause) {
  return PackingTable(file, form).read(pause);
}

}  // namespace beadwork
