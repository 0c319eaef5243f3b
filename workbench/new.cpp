#include <fcntl.h>
#include <fmt/format.h>

#include <filesystem>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "core/io/file.hpp"
#include "workbench/describe.hpp"
#include "workbench/terminal.hpp"
#include "workbench/verbs.hpp"

namespace beadwork {

namespace {

// A deck without stages ends where its mover says, so there 'until' is no option.
// Of parameters that stand for one another the first is written.
bool to_be_filled_in(const Described& each, const ParamBase& param) {
  const std::string& group = param.info().one_of;
  const bool first_of_group = !group.empty() && each.plugin->one_of(group).front() == &param;
  return param.needed() || first_of_group || (each.kind == Kind::move && param.info().name == "until");
}

std::string in_comment(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at)) text.replace(at, 2, "- -");
  return text;
}

std::string help_line(const Plugin& plugin, const ParamBase& param) {
  std::string type = type_words(param);
  if (!param.info().one_of.empty()) type += ", " + presence_words(plugin, param);
  if (const std::string range = range_words(param); !range.empty()) type += ", " + range;
  if (param.info().fallback) type += fmt::format(", default {}", *param.info().fallback);
  return fmt::format("         {} ({}): {}\n", param.info().name, type, param.info().doc);
}

// What is required stands in the tag, empty, and so is an error until it is filled in; the rest is told only.
std::string skeleton(const Described& each) {
  std::string wanted, optional, attributes;
  for (const ParamBase* param : each.plugin->params()) {
    const bool fill_in = to_be_filled_in(each, *param);
    (fill_in ? wanted : optional) += help_line(*each.plugin, *param);
    if (fill_in) attributes += fmt::format(" {}=\"\"", param->info().name);
  }
  std::string comment = each.about + ".\n";
  if (!wanted.empty()) comment += "       to be filled in:\n" + wanted;
  if (!optional.empty()) comment += "       may be added:\n" + optional;
  comment.pop_back();
  return fmt::format("    <!-- {} -->\n    <{}{}/>\n", in_comment(comment), each.tag, attributes);
}

// What editors check and complete a deck by: the schema that was installed, or built, with this program.
std::string schema_attributes() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto schema = (program.parent_path() / "../share/beadwork/beadwork.xsd").lexically_normal();
  if (error || !std::filesystem::exists(schema, error)) return "";
  return fmt::format(
      "\n       xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" xsi:noNamespaceSchemaLocation=\"{}\"",
      xml_escaped(schema.string()));
}

std::string skeleton_deck(const Manual& chosen, const std::string& name) {
  std::string text = fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<scene name=\"{}\" seed=\"1\"{}>\n",
                                 xml_escaped(name), schema_attributes());
  for (const KindRow& row : all_kinds) {
    std::string section;
    for (const Described& each : chosen)
      if (each.kind == row.kind) section += skeleton(each);
    if (!section.empty()) text += fmt::format("  <{0}>\n{1}  </{0}>\n", row.name, section);
  }
  return text + "</scene>\n";
}

struct NewArguments {
  std::vector<std::string> plugins, libraries;
  std::string out;
};

Described choose(const Catalogue& catalogue, const std::string& wanted) {
  Manual found = pick(manual_of(catalogue), wanted);
  if (found.size() > 1)
    throw DeckFailure(
        fmt::format("error: '{}' is both {} and {}: say which", wanted, found[0].path(), found[1].path()));
  if (found.front().kind == Kind::derive)
    throw DeckFailure(
        fmt::format("error: <{}> never stands in a deck: it is added where its field is read", found.front().tag));
  return std::move(found.front());
}

int make_deck(const NewArguments& arguments) {
  const Catalogue catalogue = Catalogue::open({arguments.libraries.begin(), arguments.libraries.end()});
  Manual chosen;
  for (const std::string& wanted : arguments.plugins) chosen.push_back(choose(catalogue, wanted));
  const std::filesystem::path out = arguments.out;
  const std::string text = skeleton_deck(chosen, out.empty() ? "new" : out.stem().string());
  if (out.empty()) {
    write_out(text);
    return 0;
  }
  std::error_code error;
  const auto there = std::filesystem::symlink_status(out, error);  // what a link leads to is somebody else's
  if (std::filesystem::exists(there))
    throw DeckFailure(fmt::format("error: '{}' exists already; choose another name", out.string()));
  if (error && !std::filesystem::status_known(there))
    throw DeckFailure(fmt::format("error: '{}' cannot be the name of a deck: {}", out.string(), error.message()));
  const Descriptor file = open_regular(out, O_WRONLY | O_CREAT | O_EXCL, "write");
  if (const int number = write_all(file.number(), text.data(), text.size())) throw file_failure("write", out, number);
  say("{0}: now fill in what 'beadwork check {0}' asks for\n", out.string());
  return 0;
}

}  // namespace

void add_new(CLI::App& app, Chosen& chosen) {
  CLI::App* verb = app.add_subcommand("new", "Writes the skeleton of a deck with the plugins that you choose");
  verb->footer("Example: beadwork new free-filling cohesive-beam hold pull verlet force-curve --out deck.xml");
  auto arguments = std::make_shared<NewArguments>();
  verb->add_option("plugin", arguments->plugins, "Plugins, such as bond/cohesive-beam or cohesive-beam")->required();
  verb->add_option("--out", arguments->out, "File to be written; standard output where absent");
  verb->add_option("--plugins", arguments->libraries, "A plugin library, or a folder of them")->allow_extra_args(false);
  verb->callback([&chosen, arguments] { chosen = [arguments] { return make_deck(*arguments); }; });
}

}  // namespace beadwork
