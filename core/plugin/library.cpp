#include "core/plugin/library.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <boost/dll/shared_library.hpp>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "core/base/failure.hpp"
#include "core/plugin/elf.hpp"
#include "core/plugin/stamp.hpp"

namespace beadwork {

namespace {

// What the loader says is lost on the way through Boost.DLL; it is asked once more.
std::string why_not(const std::filesystem::path& path) {
  dlerror();
  dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  const char* said = dlerror();
  const std::string reason = said ? said : "it cannot be loaded";
  return reason.starts_with(path.string() + ": ") ? reason.substr(path.string().size() + 2) : reason;
}

// What a child does of the loading, for the parent to see whether it lives through it.
[[noreturn]] void load_and_end(const std::filesystem::path& path) {
  constexpr unsigned patience = 20;  // s
  for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGALRM}) std::signal(signal, SIG_DFL);
  if (const int nowhere = ::open("/dev/null", O_WRONLY); nowhere >= 0)
    ::dup2(nowhere, STDOUT_FILENO), ::dup2(nowhere, STDERR_FILENO);
  ::alarm(patience);
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  const auto stamp = library ? reinterpret_cast<StampEntry*>(dlsym(library, stamp_entry)) : nullptr;
  const auto list = library ? reinterpret_cast<ListEntry*>(dlsym(library, list_entry)) : nullptr;
  try {
    if (const char* theirs = stamp ? stamp() : nullptr; theirs && list && theirs == compiled_stamp())
      for (const PluginEntry& entry : *list()) static_cast<void>(entry.tag.size());
  } catch (...) {  // told of by the parent, which does all this once more
  }
  ::_exit(0);
}

// A file that is a library by its tables and damaged beyond them ends the process that loads it: a child goes first.
std::string why_it_would_end_us(const std::filesystem::path& path) {
  const pid_t child = ::fork();
  if (child == 0) load_and_end(path);
  int status = 0;
  while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (child < 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 0)) return "";
  if (!WIFSIGNALED(status)) return "the system's loader gives up on it: the file is damaged; build it anew";
  return fmt::format(
      "loading it ends a process ({}): the file is damaged, or what the library does as it is loaded fails; build it "
      "anew",
      ::strsignal(WTERMSIG(status)));
}

bool has(std::string_view set) {
#if defined(__x86_64__)
  if (set == "avx2") return __builtin_cpu_supports("avx2");
  if (set == "avx512")
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
#endif
  return false;
}

}  // namespace

std::vector<std::string> instruction_sets() {
  const std::vector<std::string> known{"avx512", "avx2", "baseline"};
  const char* variable = std::getenv("BEADWORK_INSTRUCTIONS");
  const auto widest = variable && *variable ? std::find(known.begin(), known.end(), variable) : known.begin();
  if (widest == known.end())
    throw LibraryFailure(fmt::format("BEADWORK_INSTRUCTIONS is \"{}\"; it may be baseline, avx2 or avx512", variable));
  std::vector<std::string> sets;
  std::copy_if(widest, known.end(), std::back_inserter(sets), has);
  return sets;
}

std::filesystem::path widest_variant(const std::filesystem::path& path, const std::vector<std::string>& sets) {
  for (const std::string& set : sets) {
    const auto variant = path.parent_path() / set / path.filename();
    std::error_code ignored;
    if (std::filesystem::exists(variant, ignored)) return variant;
  }
  return path;
}

Library open_library(const std::filesystem::path& path, Trust trust) {
  std::string why = why_no_shared_library(path);
  if (why.empty() && trust == Trust::none) why = why_it_would_end_us(path);
  if (!why.empty()) throw LibraryFailure(fmt::format("cannot open plugin library {}: {}", path.string(), why));
  boost::dll::fs::error_code error;
  auto* library = new boost::dll::shared_library;  // never unloaded, on purpose
  library->load(path, boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local, error);
  if (error) throw LibraryFailure(fmt::format("cannot open plugin library {}: {}", path.string(), why_not(path)));
  if (!library->has(stamp_entry) || !library->has(list_entry))
    throw LibraryFailure(fmt::format("{} is no plugin library: it lacks {} or {} (build it with beadwork_add_plugins)",
                                     path.string(), stamp_entry, list_entry));
  const auto ask = [&](const auto& entry) {
    try {
      return entry();
    } catch (const std::exception& error_of_theirs) {
      throw LibraryFailure(fmt::format("plugin library {} failed as it was asked for its plugins: {}", path.string(),
                                       error_of_theirs.what()));
    } catch (...) {
      throw LibraryFailure(fmt::format(
          "plugin library {} failed as it was asked for its plugins: it threw something that is no std::exception",
          path.string()));
    }
  };
  const char* stamp = ask([&] { return library->get<StampEntry>(stamp_entry)(); });
  const std::string theirs = stamp ? stamp : "none";
  const std::string ours = compiled_stamp();
  if (theirs != ours)
    throw LibraryFailure(
        fmt::format("plugin library {} does not fit this program: rebuild it\n  library: {}\n  program: {}",
                    path.string(), theirs, ours));
  const auto* list = ask([&] { return library->get<ListEntry>(list_entry)(); });
  if (!list) throw LibraryFailure(fmt::format("plugin library {} hands over no list of plugins", path.string()));
  for (const PluginEntry& entry : *list)
    if (!entry.make || !is_kind(entry.kind))
      throw LibraryFailure(
          fmt::format("plugin library {} hands over <{}>, which is of no kind that there is or cannot be made",
                      path.string(), entry.tag));
  return {path, theirs, *list};
}

}  // namespace beadwork
