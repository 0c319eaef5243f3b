#pragma once
// What a terminal shows while one waits: a bar, how much is done, about how long it will take, and where the work
// stands.

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/headway.hpp"

namespace beadwork {

/// Time to go, by how fast the work went lately: the longer it goes on, the slower the estimate forgets.
class TimeToGo {
 public:
  /// `now`: seconds of any clock. A share below the one before begins anew.
  void note(double now, double share);
  /// [s]; nothing during the first seconds, or where the work stands still.
  std::optional<double> seconds() const;

 private:
  double began_ = 0, last_ = 0, share_ = -1;
  double rate_ = 0;  // share per second
};

/// "40 s", "12 min", "3.5 h"
std::string duration_text(double seconds);

/// One line of at most `width` columns: "45 % [######........] 30 s to go  stage 'pull', step 1200". What does not fit is left out from
/// the end; the bar goes first where the terminal is narrow.
std::string progress_line(const Headway& headway, std::optional<double> seconds_to_go, std::size_t width);

/// Tells whoever has started this program how far it has come, through a socket; -1 where nobody asks. One who does not
/// listen, or is gone, does not hold the work up.
void tell_batch(int socket, const Headway& headway);

/// The same of a part: "  young=30-GPa,seed=1  45 % [####....] 30 s to go".
std::string part_line(const std::string& name, double share, std::optional<double> seconds_to_go, std::size_t width);

/// On a terminal one line, which is written over; elsewhere a line a minute for the log.
class Progress {
 public:
  /// `log` takes the lines where no terminal shows them. `on_terminal`: whether standard error, if it is a terminal, is
  /// to show anything.
  explicit Progress(std::function<void(const std::string&)> log, bool on_terminal = true);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { hide(); }

  /// A piece of work among several that go on at once.
  struct Part {
    std::string name;
    double share = 0;
  };
  /// On a terminal each part has a line of its own below, as far as they fit.
  void show(const Headway& headway, const std::vector<Part>& parts = {});
  /// Takes the lines away, before others are written; it comes back by itself.
  void hide();

 private:
  using Clock = std::chrono::steady_clock;
  void write(const std::vector<std::string>& lines);
  std::vector<std::string> lines_of(const std::vector<Part>& parts, double now);

  std::function<void(const std::string&)> log_;
  bool terminal_;
  std::size_t shown_ = 0;  // lines
  std::map<std::string, TimeToGo> parts_to_go_;
  std::string work_;
  TimeToGo to_go_;
  Clock::time_point began_ = Clock::now(), last_shown_, last_logged_ = began_;
};

}  // namespace beadwork
