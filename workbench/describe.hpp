#pragma once
// The manual of all plugins, in several forms, each made from the plugins' own declarations and nothing else.

#include <memory>
#include <string>
#include <vector>

#include "core/plugin/catalogue.hpp"

namespace beadwork {

struct Described {
  Kind kind;
  std::string tag, about;
  std::unique_ptr<Plugin> plugin;  ///< as declared: no deck has configured it

  std::string path() const { return std::string(kind_name(kind)) + "/" + tag; }
  /// Fields that it may touch, whatever a deck chooses.
  std::vector<const FieldUse*> touched() const;
};
using Manual = std::vector<Described>;

/// Every plugin, by section and then by name.
Manual manual_of(const Catalogue& catalogue);
/// "bond/cohesive-beam", or its tag alone. DeckFailure with a suggestion if there is none.
Manual pick(Manual manual, const std::string& wanted);

std::string as_markdown(const Manual& manual);
/// For a terminal, in lines of at most `width` characters: what there is, and all of it.
std::string as_list(const Manual& manual, std::size_t width);
std::string as_text(const Manual& manual, std::size_t width);
std::string as_json(const Manual& manual);
/// XSD 1.0 for decks and for the files that they include.
std::string as_xsd(const Manual& manual);

/// What a plugin does with a field, in a word: "reads", "adds", "offers", "fills", "keeps".
const char* use_word(Kind kind, Verb verb);
/// "quantity in Pa", "one of each, mean": the type of a parameter with its unit.
std::string type_words(const ParamBase& param);
/// "> 0 Pa", or "" where anything goes.
std::string range_words(const ParamBase& param);
/// Whether a parameter without a fallback has to be there: "required", "optional", "one of velocity, table".
std::string presence_words(const Plugin& plugin, const ParamBase& param);
/// What the parameter means, with the names that a formula knows.
std::string meaning(const ParamBase& param);

}  // namespace beadwork
