#pragma once
// Lines of a log that would come again and again: the first on each subject is said, the others are counted.

#include <functional>
#include <string>
#include <vector>

namespace beadwork {

class Repeats {
 public:
  using Say = std::function<void(const std::string&)>;
  explicit Repeats(Say say) : say_(std::move(say)) {}

  /// Says the first line on `subject`, and keeps the newest of those that follow. A line that says the same as the one before it does
  /// not count.
  void say(const std::string& subject, const std::string& line);
  /// Says of each subject on which more was heard the newest line, and how many were left out before it.
  void conclude();

 private:
  struct Heard {
    std::string subject, newest;
    int more = 0;  ///< after the one that was said
  };
  Say say_;
  std::vector<Heard> heard_;
};

}  // namespace beadwork
