#include "workbench/report/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/utf8.hpp"

namespace beadwork::report {

namespace {

constexpr std::string_view thin_space = "\u202f";

std::string grouped(std::string digits) {
  const std::size_t start = digits.starts_with('-') ? 1 : 0;
  const std::size_t point = std::min(digits.find('.'), digits.size());
  if (point - start < 5) return digits;  // 9999 reads well as it is
  for (std::size_t at = point; at > start + 3; at -= 3) digits.insert(at - 3, thin_space);
  return digits;
}

std::string superscript(int exponent) {
  static constexpr std::array<std::string_view, 10> digit = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = exponent < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(exponent))) out += digit[static_cast<std::size_t>(c - '0')];
  return out;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : safe_text(text)) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else
      out += c;
  }
  return out;
}

std::string number(double value, int significant) {
  if (!std::isfinite(value)) return "–";
  if (value < 0) return "−" + number(-value, significant);
  if (value == 0) return "0";
  if (value >= 1e7 || value < 1e-3) {
    const std::string text = fmt::format("{:.{}e}", value, significant - 1);
    const std::size_t e = text.find('e');
    std::string mantissa = text.substr(0, e);
    mantissa.erase(mantissa.find_last_not_of('0') + 1);
    if (mantissa.ends_with('.')) mantissa.pop_back();
    return mantissa + " × 10" + superscript(std::stoi(text.substr(e + 1)));
  }
  const int decimals = std::max(0, significant - 1 - static_cast<int>(std::floor(std::log10(value))));
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
  }
  return grouped(text);
}

std::string count(std::int64_t n) { return grouped(std::to_string(n)); }

std::string duration(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) return "–";
  if (seconds < 60) return number(seconds, 3) + " s";
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, (whole % 3600) / 60);
}

std::string percent(double share) {
  if (!std::isfinite(share)) return "–";
  return fmt::format("{}{:.{}f} %", share < 0 ? "−" : "", 100 * std::abs(share), std::abs(share) < 0.1 ? 2 : 1);
}

std::string plural(std::int64_t n, const std::string& one) { return count(n) + " " + one + (n == 1 ? "" : "s"); }

std::string spaced(std::string_view name) {
  std::string out(name);
  std::replace(out.begin(), out.end(), '_', ' ');
  return out;
}

Scale readable(const std::string& unit, double largest) {
  static constexpr std::array<std::string_view, 8> scalable = {"m", "s", "N", "J", "Pa", "W", "m/s", "Hz"};
  struct Prefix {
    double size;
    std::string_view sign;
  };
  static constexpr std::array<Prefix, 8> prefixes = {
      {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "µ"}, {1e-9, "n"}, {1e-12, "p"}}};
  if (std::find(scalable.begin(), scalable.end(), unit) == scalable.end() || !std::isfinite(largest) || largest <= 0)
    return {1, unit};
  const bool large_time = unit == "s" && largest >= 1;  // nobody reads kiloseconds
  if (large_time || (largest >= 0.5 && largest < 2000)) return {1, unit};
  for (const Prefix& p : prefixes)
    if (largest >= p.size * 0.9999) return {1 / p.size, std::string(p.sign) + unit};
  return {1, unit};
}

std::string with_unit(const std::string& name, const std::string& unit) {
  if (unit.empty() || unit == "1") return name;
  return name + " [" + unit + "]";
}

std::string base64(const void* data, std::size_t size) {
  static constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::string out;
  out.reserve((size + 2) / 3 * 4);
  for (std::size_t i = 0; i < size; i += 3) {
    const std::size_t left = std::min<std::size_t>(3, size - i);
    unsigned three = static_cast<unsigned>(bytes[i]) << 16U;
    if (left > 1) three |= static_cast<unsigned>(bytes[i + 1]) << 8U;
    if (left > 2) three |= static_cast<unsigned>(bytes[i + 2]);
    for (std::size_t k = 0; k < 4; ++k) out += k <= left ? letters[(three >> (18 - 6 * k)) & 63U] : '=';
  }
  return out;
}

}  // namespace beadwork::report
