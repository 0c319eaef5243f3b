#include <cstdlib>

#include "core/deck/deck.hpp"
#include "core/deck/write.hpp"
#include "tests/fuzz/input.hpp"

using namespace beadwork;

namespace {

void look_at(const Node& node, const Deck& deck, Complaints& complaints) {
  for (const Attribute& attribute : node.attributes) deck.scope.text(attribute.value, node.at, complaints);
  for (const auto& child : node.children) look_at(*child, deck, complaints);
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  return fuzz::refused_or_read([&] {
    Complaints complaints;
    const auto deck = read_deck(fuzz::as_file(text, "deck.xml").string(), {{"seed", "2"}}, complaints);
    if (!deck && complaints.errors() == 0) std::abort();
    if (deck) {
      for (const std::string& name : deck->scope.names()) deck->scope.values(name, {}, complaints);
      look_at(*deck->root, *deck, complaints);
      deck->scope.complain_about_unused(*deck->root, complaints);
    }
    complaints.text();
  });
}
