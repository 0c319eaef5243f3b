#pragma once
// What is said and warned of on the way: the core neither prints nor keeps it, whoever runs it listens.

#include <functional>
#include <string>
#include <vector>

namespace beadwork {

class Log {
 public:
  using Line = std::function<void(const std::string&)>;

  /// Nobody listens.
  Log() = default;
  Log(Line say, Line warn) : say_(std::move(say)), warn_(std::move(warn)) {}

  void say(const std::string& line) const { say_(line); }
  void warn(const std::string& line) const { warn_(line); }

  /// For what may come again and again: says the first line on `subject`, and keeps the newest of those that follow. A
  /// line that says the same as the one before it does not count.
  void say_once(const std::string& subject, const std::string& line);
  /// Says of each subject on which more was heard the newest line, and how many were left out before it.
  void conclude();

 private:
  struct Heard {
    std::string subject, newest;
    int more = 0;  ///< after the one that was said
  };
  Line say_ = [](const std::string&) {}, warn_ = say_;
  std::vector<Heard> heard_;
};

}  // namespace beadwork
