#include "core/loop/former_run.hpp"

#include <vector>

#include "core/base/failure.hpp"
#include "core/io/checkpoint.hpp"
#include "core/loop/bounded_json.hpp"

namespace beadwork {

FormerRun::FormerRun(std::filesystem::path folder)
    : folder_(std::move(folder)), summary_(bounded_object<nlohmann::json>(folder_ / "summary.json")) {}

std::string FormerRun::text(const char* key) const {
  const auto found = summary_.find(key);
  return found != summary_.end() && found->is_string() ? found->get<std::string>() : "";
}

// By their order, not by their paths: deck and data may have moved together.
bool FormerRun::had(const FileSums& files) const {
  std::vector<std::string> then, now;
  if (const auto listed = summary_.find("files"); listed != summary_.end() && listed->is_object())
    for (const auto& [path, sum] : listed->items()) then.push_back(sum.is_string() ? sum.get<std::string>() : "");
  for (const auto& [path, sum] : files) now.push_back(sum);
  return then == now;
}

bool FormerRun::can_go_on(const FileSums& files) const {
  std::error_code error;
  if (!std::filesystem::exists(folder_ / "checkpoint.h5", error)) return false;
  try {
    read_checkpoint_meta(folder_ / "checkpoint.h5");
  } catch (const MachineFailure&) {
    return false;
  }
  if (is_done()) return had(files);
  if (text("status") != "failed") return true;
  const auto code = summary_.find("exit_code");
  return code != summary_.end() && *code == static_cast<int>(ExitCode::machine);
}

}  // namespace beadwork
