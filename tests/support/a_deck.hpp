#pragma once
// What tests of decks' texts need: a deck in a folder of its own, and what is said of it.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/base/failure.hpp"
#include "core/deck/deck.hpp"
#include "core/deck/read.hpp"

namespace beadwork::testing {

/// Decks in a folder of their own.
class ADeck : public ::testing::Test {
 protected:
  ADeck()
      : folder(std::filesystem::path(::testing::TempDir()) /
               ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::filesystem::current_path(folder);
  }
  ~ADeck() override { std::filesystem::current_path("/"), std::filesystem::remove_all(folder); }

  static void file(const std::string& name, const std::string& text) { std::ofstream(name, std::ios::binary) << text; }

  /// Reads a deck of this text.
  Deck& read(const std::string& text, const std::vector<Override>& overrides = {},
             const std::vector<std::pair<std::string, std::string>>& others = {}) {
    file("deck.xml", text);
    for (const auto& [name, other] : others) file(name, other);
    deck = read_deck("deck.xml", overrides, complaints);
    if (!deck) {
      ADD_FAILURE() << complaints.text();
      throw DeckFailure("");
    }
    return *deck;
  }

  /// The first line of what is said about a deck of this text.
  static std::string complaint(const std::string& text, const std::vector<Override>& overrides = {}) {
    file("deck.xml", text);
    Complaints fresh;
    read_deck("deck.xml", overrides, fresh);
    EXPECT_GE(fresh.errors(), 1) << text;
    return fresh.text().substr(0, fresh.text().find('\n'));
  }

  /// The first child with this tag.
  static const Node& child(const Node& of, const std::string& tag) {
    for (const auto& each : of.children)
      if (each->tag == tag) return *each;
    throw std::logic_error("there is no <" + tag + ">");
  }
  const Attribute& attribute(const std::string& name) { return *child(*deck->root, "a").find(name); }

  std::filesystem::path folder;
  Complaints complaints;
  std::unique_ptr<Deck> deck;
};

}  // namespace beadwork::testing
