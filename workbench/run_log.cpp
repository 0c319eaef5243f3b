#include "workbench/run_log.hpp"

#include <fcntl.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

#include <mutex>

#include "core/base/utf8.hpp"
#include "core/io/file.hpp"

namespace beadwork {

namespace {

class FileSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  FileSink(const std::filesystem::path& file, bool append)
      : file_(open_regular(file, O_WRONLY | O_CREAT | O_APPEND | (append ? 0 : O_TRUNC), "write")) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    write_all(file_.number(), line.data(), line.size());
  }
  void flush_() override {}

  Descriptor file_;
};

/// The words of a line, fit for a terminal and a file, whoever said them.
class SafeWords final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    const std::string safe = safe_text({message.payload.data(), message.payload.size()});
    out.append(safe.data(), safe.data() + safe.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<SafeWords>(); }
};

/// A pattern in which %* stands for the words.
std::unique_ptr<spdlog::formatter> line_format(const std::string& pattern) {
  auto format = std::make_unique<spdlog::pattern_formatter>();
  format->add_flag<SafeWords>('*').set_pattern(pattern);
  return format;
}

std::string pattern_of(const std::string& label) {
  if (label.empty()) return "%*";
  std::string pattern = "[";
  for (const char c : safe_text(label)) pattern += c == '%' ? std::string("%%") : std::string(1, c);
  return pattern + "] %*";
}

}  // namespace

std::shared_ptr<spdlog::logger> make_run_log(const std::filesystem::path& file, bool append, bool quiet,
                                             const std::string& label) {
  auto sink = std::make_shared<FileSink>(file, append);
  auto console = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
  sink->set_formatter(line_format("%Y-%m-%d %H:%M:%S %l %*"));
  console->set_formatter(line_format(pattern_of(label)));
  console->set_level(quiet ? spdlog::level::warn : spdlog::level::info);
  auto log = std::make_shared<spdlog::logger>("run", spdlog::sinks_init_list{sink, console});
  log->flush_on(spdlog::level::info);
  log->set_error_handler([](const std::string&) {});
  return log;
}

void note_in_file(const spdlog::logger& log, const std::string& line) {
  log.sinks().front()->log({log.name(), spdlog::level::info, line});
}

}  // namespace beadwork
