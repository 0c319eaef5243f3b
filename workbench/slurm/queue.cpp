#include "workbench/slurm/queue.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "core/base/failure.hpp"
#include "core/base/text.hpp"
#include "workbench/slurm/tool.hpp"

namespace beadwork::slurm {

namespace {

std::optional<std::size_t> whole_number(std::string_view text) {
  const auto number = parse_number(text);
  if (!number || *number < 0 || *number > 1e9) return std::nullopt;
  return static_cast<std::size_t>(*number);
}

std::string_view first_word(std::string_view text) { return text.substr(0, text.find_first_of(" +\n")); }

/// "MaxArraySize            = 1001" -> "1001"
std::string setting(const std::string& config, const std::string& name) {
  for (const std::string& line : split(config, '\n')) {
    const std::size_t equals = line.find('=');
    if (equals != std::string::npos && trim(line.substr(0, equals)) == name)
      return std::string(trim(line.substr(equals + 1)));
  }
  return "";
}

/// "a=1,b=2" and "b" -> 2
std::optional<std::size_t> among(const std::string& list, const std::string& name) {
  for (const std::string& each : split(list, ','))
    if (each.starts_with(name + "=")) return whole_number(each.substr(name.size() + 1));
  return std::nullopt;
}

MachineFailure no_slurm(const char* program, const Answer& answer) {
  if (answer.code == 127)
    return MachineFailure(fmt::format("error: there is no {} here: give this command where Slurm is", program));
  return MachineFailure(fmt::format("error: Slurm does not answer: {}", trim(answer.error)));
}

/// What the batch itself tells sbatch, or what would not submit a script.
constexpr std::array own_options{
    "array",      "comment", "cpus-per-task", "dependency", "error",   "help", "input", "output", "kill-on-invalid-dep",
    "parsable",   "quiet",   "test-only",     "usage",      "version", "wait", "wrap",  "batch",  "ignore-pbs",
    "no-requeue", "clusters"};
constexpr std::string_view own_letters = "acdehioMQVW";

bool is_own(const std::string& word) {
  if (!word.starts_with("--")) return own_letters.find(word[1]) != std::string_view::npos;
  const std::string name = word.substr(2, word.find('=') - 2);
  // getopt takes a beginning for the whole
  return std::any_of(own_options.begin(), own_options.end(),
                     [&](const char* own) { return std::string_view(own).starts_with(name); });
}

}  // namespace

bool Seen::has_ended() const {
  constexpr std::array ended{"BOOT_FAIL", "CANCELLED",     "COMPLETED", "DEADLINE", "FAILED",
                             "NODE_FAIL", "OUT_OF_MEMORY", "PREEMPTED", "REVOKED",  "TIMEOUT"};
  return std::find(ended.begin(), ended.end(), state) != ended.end();
}

Limits limits_in(const std::string& config) {
  Limits limits;
  if (const auto size = whole_number(setting(config, "MaxArraySize"))) limits.tasks = *size;
  const std::string scheduler = setting(config, "SchedulerParameters");
  if (const auto tasks = among(scheduler, "max_array_tasks")) limits.tasks = std::min(limits.tasks, *tasks);
  if (const auto bytes = among(scheduler, "max_script_size")) limits.bytes = std::min(limits.bytes, *bytes * 3 / 4);
  return limits;
}

Limits Controller::limits() {
  const Answer answer = ask({"scontrol", "show", "config"});
  if (answer.code != 0) throw no_slurm("scontrol", answer);
  const Limits found = limits_in(answer.out);
  if (found.tasks == 0) throw MachineFailure("error: this Slurm takes no arrays of jobs: its MaxArraySize is 0");
  return found;
}

std::map<Place, Seen> queue_in(const std::string& text) {
  std::map<Place, Seen> all;
  for (const std::string& line : split(text, '\n')) {  // word|task|state|array|reason
    const std::vector<std::string> pieces = split(line, '|');
    if (pieces.size() < 5) continue;
    const auto task = whole_number(pieces[1]);
    if (!task) continue;
    all[{pieces[0], *task}] = {pieces[2], join({pieces.begin() + 4, pieces.end()}, "|"), pieces[3]};
  }
  return all;
}

bool is_here() { return ask({"squeue", "--version"}).code != 127; }

std::optional<std::map<Place, Seen>> Controller::queue() {
  const Answer answer = ask({"squeue", "--noheader", "--array", "--states=all", "--user=" + std::to_string(::getuid()),
                             "--format=%k|%K|%T|%F|%r"});
  if (answer.code != 0) return std::nullopt;
  return queue_in(answer.out);
}

std::string Controller::state_of_gone(const std::string& array, std::size_t task) {
  const std::string name = fmt::format("{}_{}", array, task);
  const Answer account = ask({"sacct", "-X", "-n", "-P", "-j", name, "-o", "State"});
  if (account.code == 0 && !trim(account.out).empty()) return std::string(first_word(trim(account.out)));
  const Answer job = ask({"scontrol", "show", "job", name});
  const std::size_t at = job.out.find("JobState=");
  if (job.code != 0 || at == std::string::npos) return "";
  return std::string(first_word(std::string_view(job.out).substr(at + 9)));
}

std::string told(const std::string& state, const std::string& reason) {
  static const std::map<std::string, std::string> meanings{{"TIMEOUT", "it took longer than it was given"},
                                                           {"OUT_OF_MEMORY", "it took more memory than it was given"},
                                                           {"NODE_FAIL", "its node failed"},
                                                           {"BOOT_FAIL", "its node did not start"},
                                                           {"DEADLINE", "its deadline passed"},
                                                           {"PREEMPTED", "others went before"}};
  if (const auto found = meanings.find(state); found != meanings.end())
    return fmt::format("Slurm: {}, {}", state, found->second);
  if (state.empty()) return "Slurm: gone from the queue, cancelled or forgotten";
  if (reason.empty() || reason == "None" || reason == "NonZeroExitCode") return "Slurm: " + state;
  return fmt::format("Slurm: {} ({})", state, reason);
}

Submission refusal_in(const std::string& text) {
  const auto says = [&](const char* sign) { return text.find(sign) != std::string::npos; };
  Submission refused{"", std::string(trim(text)), false, false};
  for (const char* sign : {"QOS policy", "SubmitJob", "temporarily unable", "too long"})
    if (says(sign)) refused.is_limit = true;
  for (const char* sign : {"Unable to contact", "timed out", "Connection refused", "Connection reset", "Zero Bytes",
                           "receive failure", "connection failure"})
    if (says(sign)) refused.is_unsure = true;
  return refused;
}

Submission Controller::submit(const std::vector<std::string>& options, const std::string& script, int kept) {
  std::vector<std::string> command{"sbatch", "--parsable"};
  command.insert(command.end(), options.begin(), options.end());
  const Answer answer = ask(command, script, kept);
  if (answer.code == 127) throw no_slurm("sbatch", answer);
  if (answer.code == 0) {  // "17", or "17;cluster"
    const std::string job(trim(answer.out.substr(0, answer.out.find(';'))));
    if (whole_number(job)) return {job, "", false, false};
  }
  constexpr int killed = 128;
  Submission refused = refusal_in(answer.error);
  refused.is_unsure = refused.is_unsure || answer.code == 0 || answer.code >= killed;
  return refused;
}

std::vector<std::string> user_options(const std::vector<std::string>& texts) {
  std::vector<std::string> all;
  for (const std::string& text : texts) {
    const std::vector<std::string> words = split_words(text);
    bool takes_value = false;  // perhaps: only sbatch knows
    for (const std::string& word : words) {
      const bool is_option = word.size() > 1 && word.front() == '-';
      if (!is_option && !takes_value)
        throw DeckFailure(
            fmt::format("error: --sbatch wants options of sbatch, such as '--partition=long --time=4:00:00', got "
                        "\"{}\"",
                        text));
      if (is_option && word.size() > 2 && word[1] != '-')
        throw DeckFailure(fmt::format(
            "error: --sbatch takes long options, or a letter with its value behind a blank, not {}: one letter may "
            "stand for several",
            word));
      if (is_option && is_own(word))
        throw DeckFailure(fmt::format("error: --sbatch may not give {}: the batch itself says so to sbatch", word));
      takes_value = is_option && word.find('=') == std::string::npos;
      all.push_back(word);
    }
  }
  return all;
}

}  // namespace beadwork::slurm
