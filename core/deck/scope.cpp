#include "core/deck/scope.hpp"

#include <algorithm>

#include "core/base/text.hpp"
#include "core/base/utf8.hpp"
#include "core/deck/deck.hpp"
#include "core/deck/pieces.hpp"
#include "core/deck/read.hpp"

namespace beadwork {

namespace {

constexpr std::size_t deepest_chain = 100;

}  // namespace

void Scope::add(Parameter parameter, Complaints& complaints) {
  if (const Entry* first = find(parameter.name)) {
    complaints.error(parameter.at,
                     "parameter '" + parameter.name + "' is already defined at " + first->parameter.at.where());
  } else {
    index_.emplace(parameter.name, entries_.size());
    entries_.push_back({std::move(parameter), false, {}, {}});
  }
}

void Scope::set(std::string_view name, std::string_view text, Complaints& complaints) {
  const std::string spelt = std::string(name) + "=" + std::string(text);
  const auto source = std::make_shared<const Source>(Source{"--set", spelt});
  const auto found = index_.find(name);
  if (found == index_.end())
    return complaints.error({source, 1, 1, 0},
                            "the deck has no parameter '" + std::string(name) + "'" + did_you_mean(name, names()));
  const Location at{source, 1, static_cast<int>(name.size()) + 2, name.size() + 1};
  if (const auto invisible = first_invisible(text))
    return complaints.error(locate(at, invisible->at), invisible->words + ", stands here: leave it out");
  Entry& entry = entries_[found->second];
  entry.parameter.text = with_plain_blanks(text);
  entry.parameter.text_at = at;
  entry.values.reset();
  entry.text.reset();
}

const Scope::Entry* Scope::find(std::string_view name) const {
  const auto found = index_.find(name);
  return found == index_.end() ? nullptr : &entries_[found->second];
}

std::vector<std::string> Scope::names() const {
  std::vector<std::string> result;
  for (const Entry& each : entries_) result.push_back(each.parameter.name);
  return result;
}

/// The entry, marked as running; the caller pops it. Null, with an error, if it is unknown or runs already.
const Scope::Entry* Scope::start(std::string_view name, const Location& asked_at, Complaints& complaints) const {
  const Entry* entry = find(name);
  if (!entry) {
    complaints.error(asked_at, "no parameter '" + std::string(name) + "'" + did_you_mean(name, names()));
    return nullptr;
  }
  entry->used = true;
  const auto first = std::find(running_.begin(), running_.end(), entry);
  if (first != running_.end()) {
    std::string circle;
    for (auto each = first; each != running_.end(); ++each) circle += (*each)->parameter.name + " -> ";
    complaints.error(entry->parameter.text_at,
                     "parameter '" + entry->parameter.name + "' depends on itself: " + circle + entry->parameter.name);
    return nullptr;
  }
  if (running_.size() == deepest_chain) {
    complaints.error(entry->parameter.text_at,
                     "parameters refer to one another more than " + std::to_string(deepest_chain) + " deep");
    return nullptr;
  }
  running_.push_back(entry);
  return entry;
}

std::optional<std::vector<Value>> Scope::values(std::string_view name, const Location& asked_at,
                                                Complaints& complaints) const {
  const Entry* known = find(name);
  if (known && known->values) {
    known->used = true;
    return *known->values;
  }
  const Entry* entry = start(name, asked_at, complaints);
  if (!entry) return {};
  const Parameter& parameter = entry->parameter;
  std::optional<ValueMistake> mistake;
  entry->values = evaluate_pieces(parameter.text, parameter.text_at, *this, complaints, mistake);
  running_.pop_back();
  if (mistake)
    complaints.error(locate(parameter.text_at, mistake->at),
                     "parameter '" + parameter.name + "' is used as a quantity at " + asked_at.where() +
                         ", but holds \"" + parameter.text + "\"" +
                         (mistake->reason.empty() ? "" : ": " + mistake->reason));
  return *entry->values;
}

std::optional<Quantity> Scope::quantity(std::string_view name, const Location& asked_at, Complaints& complaints) const {
  const auto found = values(name, asked_at, complaints);
  if (!found) return {};
  if (found->size() == 1) return found->front().quantity;
  complaints.error(asked_at, "one value is wanted here, but parameter '" + std::string(name) + "' holds " +
                                 std::to_string(found->size()));
  return {};
}

std::optional<std::string> Scope::text(std::string_view name, const Location& asked_at, Complaints& complaints) const {
  const Entry* known = find(name);
  if (known && known->text) {
    known->used = true;
    return *known->text;
  }
  const Entry* entry = start(name, asked_at, complaints);
  if (!entry) return {};
  entry->text = text_of(entry->parameter.text, entry->parameter.text_at, *this, complaints);
  running_.pop_back();
  return *entry->text;
}

namespace {

bool stands_in_names(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' || c == '-';
}

/// What may be a name in this text: each run of letters, and where it holds a -, each part from one - to another, as it
/// may stand for a difference.
void add_names(std::string_view text, std::set<std::string, std::less<>>& names) {
  constexpr std::size_t most_parts = 12;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && stands_in_names(text[end])) ++end;
    const std::vector<std::string> parts = split(text.substr(at, end - at), '-');
    for (std::size_t first = 0; first < parts.size(); ++first) {
      std::string name;
      for (std::size_t k = first; k < std::min(parts.size(), first + most_parts); ++k) {
        name += (k > first ? "-" : "") + parts[k];
        names.insert(name);
      }
    }
    at = end + 1;
  }
}

void add_names(const Node& node, std::set<std::string, std::less<>>& names) {
  for (const Attribute& each : node.attributes) add_names(each.value, names);
  for (const auto& child : node.children) add_names(*child, names);
}

}  // namespace

std::set<std::string, std::less<>> Scope::mentioned_names(const Node& root) const {
  std::set<std::string, std::less<>> names;
  add_names(root, names);
  for (const Entry& each : entries_) add_names(each.parameter.text, names);
  return names;
}

void Scope::complain_about_unused(const Node& root, Complaints& complaints) const {
  const auto mentioned = complaints.errors() > 0 ? mentioned_names(root) : std::set<std::string, std::less<>>();
  for (const Entry& each : entries_)
    if (!each.used && !each.parameter.from_library && !mentioned.contains(each.parameter.name))
      complaints.error(each.parameter.at, "parameter '" + each.parameter.name + "' is used nowhere");
}

}  // namespace beadwork
