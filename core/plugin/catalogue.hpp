#pragma once
// All plugins that a scene may be made of. An object, not a global.

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/plugin/library.hpp"

namespace beadwork {

/// Where the kernel, this very library, lies.
std::filesystem::path kernel_library();

class Catalogue {
 public:
  /// Libraries are looked for in this order: `extra` (files or folders: the deck's, then the command line's), the
  /// environment variable BEADWORK_PLUGINS (separated by ':'), and the folder `beadwork` beside the core library.
  static Catalogue open(const std::vector<std::filesystem::path>& extra);

  /// Throws LibraryFailure naming both libraries if the name is taken.
  void add(Library library);

  const PluginEntry* find(Kind kind, const std::string& tag) const;
  /// `at` names the place in the deck, if there is one, should its constructor throw.
  std::unique_ptr<Plugin> make(Kind kind, const std::string& tag, const std::string& at = "") const;
  std::vector<std::string> tags(Kind kind) const;
  /// Every kind in which this tag is known.
  std::vector<Kind> kinds_of(const std::string& tag) const;
  const std::vector<Library>& libraries() const { return libraries_; }
  /// The instruction set of the variants that were opened, baseline if none was.
  const std::string& instructions() const { return instructions_; }
  std::string library_of(Kind kind, const std::string& tag) const;
  /// The library that a deck has to name to have this plugin, whatever the command line and the environment name; "" if
  /// none.
  std::string named_library(Kind kind, const std::string& tag) const;

 private:
  struct Place {
    PluginEntry entry;
    std::filesystem::path library, named;
  };
  std::map<std::pair<Kind, std::string>, Place> entries_;
  std::vector<Library> libraries_;
  std::string instructions_ = "baseline";
};

}  // namespace beadwork
