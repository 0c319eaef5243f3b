#include "workbench/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/utf8.hpp"

namespace beadwork {

namespace {

constexpr double warm_up = 3;            // s before there is an estimate
constexpr std::size_t usual_width = 80;  // of a terminal that does not say, and of a log

std::size_t terminal_width() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual_width;
}

// Bytes of the character that begins with this one, and the columns that it takes, roughly: scripts from Hangul on take
// two.
std::size_t bytes_of(unsigned char first) { return first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4; }
std::size_t columns_of(unsigned char first, unsigned char second) {
  if (first < 0xE1 || (first == 0xE1 && second < 0x84)) return 1;
  return first == 0xE2 && second < 0xBA ? 1 : 2;  // punctuation, arrows, mathematics
}

// As much of a text as fits; control characters would move the cursor.
std::string fitted(const std::string& text, std::size_t width) {
  std::string cut;
  std::size_t taken = 0;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t length = std::min(bytes_of(first), text.size() - i);
    const bool control = first < 0x20 || first == 0x7F;
    const std::size_t columns = columns_of(first, length > 1 ? static_cast<unsigned char>(text[i + 1]) : 0);
    if (taken + columns > width) break;
    cut += control ? "?" : text.substr(i, length);
    taken += columns;
    i += length;
  }
  return cut;
}

std::string bar(double share, std::size_t width) {
  const auto full = static_cast<std::size_t>(std::lround(share * static_cast<double>(width)));
  return "[" + std::string(full, '#') + std::string(width - full, '.') + "]";
}

}  // namespace

void TimeToGo::note(double now, double share) {
  if (share < share_ || share_ < 0) {
    began_ = last_ = now;
    share_ = share;
    rate_ = 0;
    return;
  }
  const double passed = now - last_;
  if (!(passed > 0)) return;
  const double elapsed = now - began_;
  const double memory = std::min(elapsed, std::clamp(elapsed / 3, 8.0, 300.0));  // a plain mean at first
  rate_ += std::min(1.0, passed / memory) * ((share - share_) / passed - rate_);
  last_ = now;
  share_ = share;
}

std::optional<double> TimeToGo::seconds() const {
  if (last_ - began_ < warm_up || !(rate_ > 0)) return std::nullopt;
  return (1 - share_) / rate_;
}

std::string duration_text(double seconds) {
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  if (seconds < 99.5 * 60) return fmt::format("{:.0f} min", seconds / 60);
  if (seconds < 48 * 3600.0) return fmt::format("{:.1f} h", seconds / 3600);
  return fmt::format("{:.0f} days", seconds / 86400);
}

std::string progress_line(const Headway& headway, std::optional<double> seconds_to_go, std::size_t width) {
  std::string line;
  if (headway.share) {
    const double share = std::clamp<double>(*headway.share, 0, 1);
    line = fmt::format("{:3.0f} % ", std::floor(100 * share));
    if (width >= 50) line += bar(share, std::clamp<std::size_t>(width / 5, 10, 30)) + " ";
    if (seconds_to_go)
      line += fmt::format("{}{} to go  ", headway.at_most ? "at most " : "", duration_text(*seconds_to_go));
  }
  line += headway.work;
  if (!headway.detail.empty()) line += ", " + headway.detail;
  return fitted(line, width);
}

Progress::Progress(std::function<void(const std::string&)> log, bool on_terminal)
    : log_(std::move(log)), terminal_(on_terminal && ::isatty(STDERR_FILENO) == 1) {}

void Progress::show(const Headway& headway) {
  const auto now = Clock::now();
  if (headway.work != work_) {
    work_ = headway.work;
    to_go_ = {};
  } else if (now - last_shown_ < std::chrono::milliseconds(250)) {
    return;
  }
  last_shown_ = now;
  if (headway.share) to_go_.note(std::chrono::duration<double>(now - began_).count(), *headway.share);
  const auto seconds = headway.share ? to_go_.seconds() : std::nullopt;
  if (terminal_) {
    write(
        progress_line(headway, seconds, terminal_width() - 1));  // a full line would make some terminals begin another
  } else if (now - last_logged_ >= std::chrono::minutes(1)) {
    last_logged_ = now;
    log_(progress_line(headway, seconds, 200));
  }
}

void Progress::write(const std::string& line) {
  std::fprintf(stderr, "\r\x1b[K%s", safe_text(line).c_str());
  std::fflush(stderr);
  shown_ = true;
}

void Progress::hide() {
  if (!shown_) return;
  std::fputs("\r\x1b[K", stderr);
  shown_ = false;
}

}  // namespace beadwork
