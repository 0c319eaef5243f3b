#pragma once
// From the path of a deck to the scene that it describes.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/loop/scene.hpp"

namespace beadwork {

/// An attribute that the command line gives the plugin with this tag, in the place of the deck's.
struct GivenAttribute {
  std::string tag, name, value;
};

/// Which deck, and what is said of it beside.
struct DeckRequest {
  std::string path;
  std::vector<Override> overrides;
  std::vector<std::string> libraries;  ///< files or folders
  bool no_plugins = false;             ///< the libraries that the deck itself names are not loaded
  std::vector<GivenAttribute> attributes = {};
};

/// A deck, the plugins it may use, and the scene made of them.
struct Loaded {
  std::unique_ptr<Deck> deck;
  Catalogue catalogue;
  std::unique_ptr<Scene> scene;
};

/// What is wrong with the deck goes to `complaints`, warnings too; there is no scene then, and maybe no deck. Throws
/// LibraryFailure.
Loaded load_scene(const DeckRequest& request, Complaints& complaints);

}  // namespace beadwork
