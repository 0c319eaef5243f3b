#include <fmt/format.h>

#include "core/base/text.hpp"
#include "workbench/describe.hpp"

namespace beadwork {

namespace {

// A number, and a number with its unit, as regular expressions of XSD; values are checked with blanks collapsed.
const std::string number = R"([+\-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+\-]?[0-9]+)?)";
const std::string unit = R"(( ?[^ 0-9.+\-$]\S*| 1/\S+))";
const std::string zero = R"([+\-]?0(\.0*)?)";
const std::string calculation = R"(.*[*(].*|.* [+\-/] .*|[+\-]?[A-Za-z_].*)";  // there is an operator, a call or a name
const std::string expression = R"(.*[$]\{.*\}.*)";                             // its value is known to the program only

std::string doc_of(const std::string& text, const std::string& indent) {
  return fmt::format("{0}<xs:annotation><xs:documentation>{1}</xs:documentation></xs:annotation>\n", indent,
                     xml_escaped(text));
}

std::string pattern_type(const std::string& name, const std::string& pattern, const std::string& doc) {
  return fmt::format(
      "  <xs:simpleType name=\"{}\">\n{}    <xs:restriction base=\"xs:token\">\n      <xs:pattern value=\"{}\"/>\n"
      "      <xs:pattern value=\"{}\"/>\n    </xs:restriction>\n  </xs:simpleType>\n",
      name, doc_of(doc, "    "), xml_escaped(pattern), xml_escaped(expression));
}

std::string value_types() {
  std::string text = pattern_type("number", number + unit + "?", "A plain number");
  text += pattern_type("quantity", number + unit + "|" + zero, "A number with its unit: 13.5 mm; a 0 needs none");
  text += pattern_type("formula", number + unit + "|" + zero + "|" + calculation,
                       "A number with its unit, or a formula that gives one: 2 mm/s * sin(2*pi * t / 1 ms)");
  text += pattern_type("numbers", fmt::format("({0}{1}? ){{2}}{0}{1}?", number, unit), "Three values: 1 2 3 mm");
  text += pattern_type("switch", "yes|no|true|false", "yes or no");
  text += pattern_type("expression", expression, "${...}: a parameter, or an expression on quantities");
  text +=
      "  <xs:simpleType name=\"text\">\n    <xs:restriction base=\"xs:token\"><xs:minLength "
      "value=\"1\"/></xs:restriction>\n  </xs:simpleType>\n";
  return text;
}

// One of the choices (several of them, in a parameter of words), or an expression.
std::string choice_type(const std::vector<std::string>& choices, bool several, const std::string& indent) {
  std::string words = indent + "    <xs:simpleType><xs:restriction base=\"xs:token\">";
  for (const std::string& choice : choices) words += fmt::format("<xs:enumeration value=\"{}\"/>", xml_escaped(choice));
  words += "</xs:restriction></xs:simpleType>\n";
  const std::string one =
      several ? indent + "    <xs:simpleType><xs:list>\n" + words + indent + "    </xs:list></xs:simpleType>\n" : words;
  return indent + "<xs:simpleType>\n" + indent + "  <xs:union memberTypes=\"expression\">\n" + one + indent +
         "  </xs:union>\n" + indent + "</xs:simpleType>\n";
}

const char* type_of_param(const ParamBase& param) {
  const std::string words = param.type();
  if (words == "number" || words == "integer") return "number";
  if (words == "quantity") return "quantity";
  if (words == "formula" && param.info().unit != "1") return "formula";
  if (words == "three numbers") return "numbers";
  if (words == "yes or no") return "switch";
  return "text";
}

std::string attribute(const ParamBase& param) {
  const ParamInfo& info = param.info();
  std::string doc = fmt::format("{} ({}", info.doc, type_words(param));
  if (const std::string range = range_words(param); !range.empty()) doc += ", " + range;
  doc += info.fallback ? fmt::format("; default {}{})", *info.fallback,
                                     info.instead.empty() ? "" : " where there is no " + info.instead)
                       : ")";
  const std::string type = info.choices.empty() ? fmt::format(" type=\"{}\"", type_of_param(param)) : "";
  std::string text =
      fmt::format("    <xs:attribute name=\"{}\"{}{}>\n", info.name, type, param.needed() ? " use=\"required\"" : "");
  text += doc_of(doc, "      ");
  if (!info.choices.empty()) text += choice_type(info.choices, !param.type().starts_with("one of"), "      ");
  return text + "    </xs:attribute>\n";
}

std::string plugin_type(const Described& each) {
  std::string text =
      fmt::format("  <xs:complexType name=\"{}.{}\">\n{}", kind_name(each.kind), each.tag, doc_of(each.about, "    "));
  for (const ParamBase* param : each.plugin->params()) text += attribute(*param);
  return text + "  </xs:complexType>\n";
}

const char* const any_number = "<xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">";
const char* const include = "      <xs:element name=\"include\" type=\"include\"/>\n";

std::string section_type(Kind kind, const Manual& manual) {
  std::string text = fmt::format("  <xs:complexType name=\"{}\">\n{}    {}\n{}", kind_name(kind),
                                 doc_of(row_of(kind).doc, "    "), any_number, include);
  for (const Described& each : manual)
    if (each.kind == kind)
      text += fmt::format("      <xs:element name=\"{0}\" type=\"{1}.{0}\">\n{2}      </xs:element>\n", each.tag,
                          kind_name(kind), doc_of(each.about, "        "));
  return text + "    </xs:choice>\n  </xs:complexType>\n";
}

std::string plain_attribute(const std::string& name, const std::string& type, bool required, const std::string& doc) {
  return fmt::format("    <xs:attribute name=\"{}\" type=\"{}\"{}>\n{}    </xs:attribute>\n", name, type,
                     required ? " use=\"required\"" : "", doc_of(doc, "      "));
}

std::string sections(const std::vector<Kind>& kinds, bool inside_stage) {
  std::string text = fmt::format("    {}\n{}", any_number, include);
  for (const Kind kind : kinds)
    if (row_of(kind).in_stages || !inside_stage)
      text += fmt::format("      <xs:element name=\"{0}\" type=\"{0}\">\n{1}      </xs:element>\n", kind_name(kind),
                          doc_of(row_of(kind).doc, "        "));
  if (!inside_stage)
    text +=
        "      <xs:element name=\"parameter\" type=\"parameter\"/>\n      <xs:element name=\"stage\" "
        "type=\"stage\"/>\n";
  return text + "    </xs:choice>\n";
}

std::string frame_types(const std::vector<Kind>& kinds) {
  std::string text = "  <xs:complexType name=\"parameter\">\n" +
                     doc_of("A value with a name, for ${name}; --set name=value changes it", "    ");
  text += plain_attribute("name", "text", true, "Its name") +
          plain_attribute("value", "text", true, "A quantity, a list, a text or an expression");
  text += "  </xs:complexType>\n  <xs:complexType name=\"include\">\n" +
          doc_of("Another file with the root <scene>; what stands in it stands here", "    ");
  text += plain_attribute("file", "text", true, "Path from this file's folder");
  text += "  </xs:complexType>\n  <xs:complexType name=\"stage\">\n" +
          doc_of("A part of the run, in the deck's order. What stands outside of stages holds in all of them", "    ") +
          sections(kinds, true);
  text += plain_attribute("name", "text", false, "Its name") +
          plain_attribute("until", "text", false,
                          "When it ends: a time, a number of steps, a displacement, or a condition");
  text += "  </xs:complexType>\n  <xs:element name=\"scene\">\n    <xs:complexType>\n" + sections(kinds, false);
  text += plain_attribute("name", "text", false, "Name of the scene; that of the file where absent") +
          plain_attribute("seed", "number", false, "Seed of all random numbers; 0 where absent") +
          plain_attribute("plugins", "text", false, "Plugin libraries, or folders of them, from the deck's folder");
  return text + "    </xs:complexType>\n  </xs:element>\n";
}

}  // namespace

std::string as_xsd(const Manual& manual) {
  std::vector<Kind> kinds;
  for (const KindRow& row : all_kinds) kinds.push_back(row.kind);
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<!-- Made by beadwork from the declarations in the plugins (tools/update-docs.sh); do not edit. -->\n"
      "<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\">\n";
  text += frame_types(kinds);
  for (const Kind kind : kinds) text += section_type(kind, manual);
  for (const Described& each : manual) text += plugin_type(each);
  return text + value_types() + "</xs:schema>\n";
}

}  // namespace beadwork
