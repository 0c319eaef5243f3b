#include "workbench/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/utf8.hpp"

namespace beadwork {

namespace {

constexpr double warm_up = 3;            // s before there is an estimate
constexpr std::size_t usual_width = 80;  // of a terminal that does not say, and of a log

struct TerminalSize {
  std::size_t columns = usual_width, rows = 24;
};

TerminalSize terminal_size() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0) return {};
  return {size.ws_col > 0 ? size.ws_col : usual_width, size.ws_row > 0 ? size.ws_row : std::size_t{24}};
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

std::string part_line(const std::string& name, double share, std::optional<double> seconds_to_go, std::size_t width) {
  const std::size_t of_name = std::clamp<std::size_t>(width / 2, 10, 60);
  std::string line = fitted("  " + name, of_name);
  line.resize(std::max(line.size(), of_name), ' ');
  line += fmt::format(" {:3.0f} % ", std::floor(100 * std::clamp(share, 0., 1.)));
  if (width >= 50) line += bar(std::clamp(share, 0., 1.), std::clamp<std::size_t>(width / 8, 6, 20)) + " ";
  if (seconds_to_go) line += duration_text(*seconds_to_go) + " to go";
  return fitted(line, width);
}

Progress::Progress(std::function<void(const std::string&)> log, bool on_terminal)
    : log_(std::move(log)), terminal_(on_terminal && ::isatty(STDERR_FILENO) == 1) {}

void Progress::show(const Headway& headway, const std::vector<Part>& parts) {
  const auto now = Clock::now();
  if (headway.work != work_) {
    work_ = headway.work;
    to_go_ = {};
  } else if (now - last_shown_ < std::chrono::milliseconds(250)) {
    return;
  }
  last_shown_ = now;
  const double passed = std::chrono::duration<double>(now - began_).count();
  if (headway.share) to_go_.note(passed, *headway.share);
  const auto seconds = headway.share ? to_go_.seconds() : std::nullopt;
  if (terminal_) {
    // a full line would make some terminals begin another
    std::vector<std::string> lines{progress_line(headway, seconds, terminal_size().columns - 1)};
    const auto below = lines_of(parts, passed);
    lines.insert(lines.end(), below.begin(), below.end());
    write(lines);
  } else if (now - last_logged_ >= std::chrono::minutes(1)) {
    last_logged_ = now;
    log_(progress_line(headway, seconds, 200));
  }
}

std::vector<std::string> Progress::lines_of(const std::vector<Part>& parts, double now) {
  const TerminalSize size = terminal_size();
  const std::size_t room = size.rows > 3 ? size.rows - 3 : 0;
  std::vector<std::string> lines;
  std::map<std::string, TimeToGo> to_go;
  for (const Part& part : parts) {
    TimeToGo& its = to_go[part.name] = parts_to_go_[part.name];
    its.note(now, part.share);
    if (lines.size() < room) lines.push_back(part_line(part.name, part.share, its.seconds(), size.columns - 1));
  }
  parts_to_go_ = std::move(to_go);  // without those that have ended
  if (parts.size() > room && !lines.empty()) lines.back() = fmt::format("  and {} more", parts.size() - room + 1);
  return lines;
}

// The cursor waits at the beginning of the first line: what others write then stands above what is drawn next.
void Progress::write(const std::vector<std::string>& lines) {
  hide();
  for (std::size_t k = 0; k < lines.size(); ++k)
    std::fprintf(stderr, "%s\r\x1b[K%s", k ? "\n" : "", safe_text(lines[k]).c_str());
  if (lines.size() > 1) std::fprintf(stderr, "\r\x1b[%zuA", lines.size() - 1);
  std::fflush(stderr);
  shown_ = lines.size();
}

void Progress::hide() {
  if (shown_ > 0) std::fputs(shown_ > 1 ? "\r\x1b[J" : "\r\x1b[K", stderr);
  shown_ = 0;
}

void tell_batch(int socket, const Headway& headway) {
  if (socket < 0 || !headway.share || headway.work.starts_with("filling")) return;
  const std::string text = fmt::format("{:.6f}", *headway.share);
  ::send(socket, text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

}  // namespace beadwork
