#include <fmt/format.h>

#include "core/base/text.hpp"
#include "core/deck/operations.hpp"
#include "workbench/describe.hpp"

namespace beadwork {

namespace {

std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '<') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

std::string row_of(const Plugin& plugin, const ParamBase& param) {
  const ParamInfo& info = param.info();
  const std::string only = info.instead.empty() ? "" : fmt::format(" where there is no {}", code(info.instead));
  const std::string presence = presence_words(plugin, param);
  const std::string fallback = info.fallback            ? code(*info.fallback) + only
                               : presence == "optional" ? presence
                                                        : "**" + presence + "**";
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", info.name, cell(type_words(param)), cell(range_words(param)),
                     fallback, cell(meaning(param)));
}

std::string row_of(Kind kind, const FieldUse& use) {
  const Field& field = use.field();
  return fmt::format("| {} | `{}` | {} | {} | {} |\n", use_word(kind, use.verb()), field.name, place_name(field.on),
                     field.unit == "1" ? "" : field.unit, cell(field.doc));
}

std::string chapter(const Described& each) {
  std::string text = fmt::format("### `{}`\n\n{}.\n", each.tag, each.about);
  if (!each.plugin->params().empty()) {
    text += "\n| attribute | type | range | default | meaning |\n|---|---|---|---|---|\n";
    for (const ParamBase* param : each.plugin->params()) text += row_of(*each.plugin, *param);
  }
  if (!each.touched().empty()) {
    text += "\n| | field | on | unit | meaning |\n|---|---|---|---|---|\n";
    for (const FieldUse* use : each.touched()) text += row_of(each.kind, *use);
  }
  return text;
}

const char* const preface = R"(# Deck reference

Made by `beadwork describe --format md` from the declarations in the plugins; do not edit.

A deck is an XML file with the root `<scene>` (attributes `name`, `seed`, `plugins`). In it stand, in any order and any number of
times, the sections below, `<parameter name= value=>`, `<include file=>`, and `<stage name= until=>`, which wraps sections other
than `<fill>`. Any value may hold `${...}`: a parameter, or an expression on quantities.

What a plugin does with a field: it *reads* it; *adds* to it (a sum that is cleared at each evaluation); *offers* it (it exists
only if somebody reads it); *fills* it once; *keeps* it (state, saved in checkpoints).

Editors check and complete a deck whose root is `<scene xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
xsi:noNamespaceSchemaLocation="path/to/beadwork.xsd">` ([editors](../editors.md)); so does `xmllint --noout --schema beadwork.xsd
deck.xml`. An included file is a `<scene>` too and is checked alike, unless it is included inside of a section. `beadwork check`
finds what no schema can.

## Values and expressions

A quantity is a number with a unit: `13.5 mm`, `70 GPa`, `0.5 N/mm`, `2500 kg/m^3`. Several values may share the unit behind the
last: `1 2 13.5 mm`. A unit of another dimension than the attribute's is an error. A 0 needs no unit, neither as a value nor in
expressions: `x > 0`.

Names of units are spelt exactly as here, with SI prefixes where SI has them: m g s A K mol N Pa J W Hz L bar rad eV tex, their
words (`millimetre`, `kilopascals`), min h d, t (1000 kg), degree or deg, percent, ppm, in ft yd mi lb lbf kip psi ksi kgf atm mmHg.
They are joined by `.` `*` `/`, with exponents behind: `N/mm^3`, `J.m-2`, `MPa.m^0.5`. Names that mean several things (ton, gallon, calorie,
horsepower, year ...) are refused, with what to write instead.

Inside of `${...}`, and in attributes that are a formula or a condition, stand expressions on quantities:
`${0.3*length + 2 mm}`, `where="x < 13.5 mm and radius > 2 um"`. From the operator that binds least to the one that binds most:

| operator | meaning | dimensions |
|---|---|---|
| `or` `\|\|` | one condition or the other holds | conditions |
| `and` `&&` | both conditions hold | conditions |
| `not` | the condition does not hold | a condition |
| `==` `!=` `\<` `\<=` `>` `>=` | comparison | both sides alike |
| `+` `-` | sum, difference | both sides alike |
| `*` `/` | product, quotient | any |
| `-a` | opposite sign; several may follow: `--a` | any |
| `a^b` | power, from the right: `2^3^2` is `2^9` | b a plain number; a whole or broken one |
| `13.5 mm` | a number and its unit | |

In XML a `<` inside of a value is written `&lt;`. Names are parameters, `pi`, and what the attribute knows besides (its manual says
"of x, y, z"). A name may hold `.` and `-`; write blanks around a minus sign.

)";

const char* const moments = R"(
## When a stage ends: `until`

`until` of a mover or of a `<stage>` is one of these, or several joined by `or`:

| `until` | the stage ends |
|---|---|
| `1 ms` | at the step nearest to this time, counted from the start of the stage |
| `5000` | after this number of steps |
| `0.8 mm` | at the step nearest to where the set that is pulled farthest has moved as far |
| `force of SET \< 3 N`, also `>` `\<=` `>=` | when the force on a driven set passes the value; to fall below it, it must have been above it |
| `force of SET \< 2 percent of its maximum` | when it passes that share of its largest value in this stage |
| `displacement of SET > 1 mm` | when this set has moved as far |
| `sensor NAME > 3 MPa`, also `\<` `\<=` `>=` | when the last look of this sensor, in this stage, has told so |
| `time > 1 ms and displacement > 0.1 mm` | when a condition on `time`, `step` and `displacement` holds |

`at` of a watcher lists moments besides its `every`, separated by commas: times, numbers of steps or displacements as above,
`at="0 mm, 0.3 mm, 1 ms"`.
)";

std::string functions_table() {
  std::string text = "| function | meaning |\n|---|---|\n";
  for (const FunctionHelp& f : functions()) text += fmt::format("| `{}({})` | {} |\n", f.name, f.arguments, f.doc);
  return text;
}

}  // namespace

std::string as_markdown(const Manual& manual) {
  if (manual.size() == 1) return chapter(manual.front());
  std::string text = preface + functions_table() + moments;
  const char* section = nullptr;
  for (const Described& each : manual) {
    if (section != kind_name(each.kind))
      text += fmt::format("\n## `<{}>`\n\n{}\n", kind_name(each.kind), row_of(each.kind).doc);
    section = kind_name(each.kind);
    text += "\n" + chapter(each);
  }
  return text;
}

}  // namespace beadwork
