#include "core/loop/same_deck.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "core/base/complaints.hpp"
#include "core/base/failure.hpp"
#include "core/base/sha256.hpp"
#include "core/base/text.hpp"

namespace beadwork {

namespace {

std::string shown(const PlainAttribute& attribute) { return fmt::format("{}=\"{}\"", attribute.name, attribute.value); }

/// Children are told apart by their tag and by the name that a deck gives them.
std::string key_of(const PlainNode& node) {
  for (const char* name : {"name", "set", "of"})
    if (const PlainAttribute* found = node.find(name); found && node.tag != "stage")
      return node.tag + " " + found->value;
  return node.tag;
}

std::string shown(const PlainNode& node) {
  for (const char* name : {"name", "set", "of"})
    if (const PlainAttribute* found = node.find(name)) return fmt::format("<{} {}>", node.tag, shown(*found));
  return fmt::format("<{}>", node.tag);
}

std::vector<std::string> keys_of(const std::vector<PlainNode>& nodes) {
  std::vector<std::string> keys;
  for (const PlainNode& node : nodes) keys.push_back(key_of(node));
  return keys;
}

class Comparison {
 public:
  Comparison(const FileSums& saved, const FileSums& now, Complaints& complaints)
      : saved_(saved), now_(now), complaints_(complaints) {}

  /// `section` is the tag of the section in which the nodes stand, as far as they stand in one.
  void compare(const PlainNode& before, const PlainNode& now, const std::string& section) {
    for (const PlainAttribute& each : now.attributes)
      if (!may_differ(now, each.name, section)) compare(before.find(each.name), each);
    for (const PlainAttribute& each : before.attributes)
      if (!now.find(each.name) && !may_differ(now, each.name, section))
        complaints_.error(now.at, fmt::format("<{}> has {} in the run that is to go on, and no '{}' here", now.tag,
                                              shown(each), each.name));
    compare_children(before, now, now.tag == "scene" || now.tag == "stage" ? "" : now.tag);
  }

 private:
  static bool may_differ(const PlainNode& node, const std::string& name, const std::string& section) {
    if (node.tag == "scene") return name == "name" || name == "plugins";
    if (name == "until") return node.tag == "stage" || section == "move";
    return name == "every" && section == "watch";
  }

  void compare(const PlainAttribute* before, const PlainAttribute& now) {
    if (before && (before->value == now.value || is_same_file(before->value, now.value))) return;
    const std::string there = before ? fmt::format("\"{}\"", before->value) : "not given";
    complaints_.error(
        now.at, fmt::format("'{}' is \"{}\" here, but {} in the run that is to go on", now.name, now.value, there));
  }

  bool is_same_file(const std::string& before, const std::string& now) const {
    const auto left = saved_.find(before), right = now_.find(now);
    return left != saved_.end() && right != now_.end() && left->second == right->second;
  }

  void compare_children(const PlainNode& before, const PlainNode& now, const std::string& section) {
    std::size_t i = 0, j = 0;
    const auto pairs_until = [&](std::size_t end_before, std::size_t end_now) {
      while (i < end_before && j < end_now) compare(before.children[i++], now.children[j++], section);
    };
    for (const OddLine& odd : odd_lines(keys_of(before.children), keys_of(now.children))) {
      if (odd.in_second) {
        pairs_until(before.children.size(), odd.number);
        const PlainNode& node = now.children[j++];
        complaints_.error(node.at, fmt::format("{} is not in the run that is to go on", shown(node)));
      } else {
        pairs_until(odd.number, now.children.size());
        const PlainNode& node = before.children[i++];
        complaints_.error(now.at,
                          fmt::format("<{}> has {} in the run that is to go on, and not here", now.tag, shown(node)));
      }
    }
    pairs_until(before.children.size(), now.children.size());
  }

  const FileSums &saved_, &now_;
  Complaints& complaints_;
};

}  // namespace

FileSums file_sums(const std::vector<std::string>& paths) {
  FileSums sums;
  for (const std::string& path : paths)
    sums[std::filesystem::absolute(path).lexically_normal().string()] = sha256_of_file(path);
  return sums;
}

void refuse_other_deck(const DeckRecord& saved, const PlainNode& now, const FileSums& files) {
  const auto before = read_resolved_xml(saved.resolved);
  if (!before) throw MachineFailure("error: the checkpoint does not hold the deck that began the run");
  Complaints complaints;
  Comparison(saved.files, files, complaints).compare(*before, now, "");
  for (const auto& [path, sum] : files)
    if (const auto there = saved.files.find(path); there != saved.files.end() && there->second != sum)
      complaints.error({}, fmt::format("the file {} has changed since the run began", path));
  if (complaints.errors() == 0) return;
  throw DeckFailure(
      "error: the deck is not the one that began this run; only 'until', the 'every' of what stands in <watch>, the "
      "scene's name and threads may differ:\n" +
      complaints.text());
}

}  // namespace beadwork
