#pragma once
// What the three steps of filling share: the packing that they hand on, and the elements made of it.

#include <fmt/format.h>

#include <memory>

#include "core/base/failure.hpp"
#include "core/packing/packing.hpp"
#include "plugins/fill/packing_report.hpp"
#include "plugins/fill/spheres.hpp"

namespace beadwork {

struct PackingInProgress {
  packing::Packing packing;
  Real density;
  Index first_row;  ///< its elements stand from here on
  Index rows;       ///< so many: the set may hold others, made before
};

/// Filling goes wrong in two ways, both the deck's: a request that makes no sense, and one that cannot be met.
template <class Step>
void guarded(const Plugin& plugin, const Step& step) {
  try {
    step();
  } catch (const std::invalid_argument& refused) {
    refuse(plugin.at(), refused.what());
  } catch (const packing::PackingFailure& failed) {
    refuse(plugin.at(), failed.what());
  }
}

/// Hands on what a step of a packing tells of its progress; when it will end nobody knows.
inline packing::Tell teller(const FillJob& job, const Plugin& step, const std::string& set) {
  return [&job, work = fmt::format("{} '{}'", step.tag(), set)](const std::string& detail) {
    job.progress({work, detail, {}, false});
  };
}

/// A step that goes on with a packing that an earlier one began.
class PackingStep : public SphereFiller {
 public:
  Param<std::string> set{this, {.name = "set", .doc = "Set that free-filling began", .role = Role::set}};

  void fill(Domain& domain, const FillJob& job) final {
    const auto found = job.in_progress->find(*set);
    if (found == job.in_progress->end())
      refuse(at(), fmt::format("set '{}' is no packing in progress: <free-filling> has to come first", *set));
    auto& progress = *found->second;
    const std::size_t before = progress.packing.warnings.size();
    progress.packing.pause = job.pause;
    progress.packing.tell = teller(job, *this, *set);
    guarded(*this, [&] { go_on(progress.packing); });
    for (std::size_t w = before; w < progress.packing.warnings.size(); ++w) job.log.warn(progress.packing.warnings[w]);
    place(domain, progress);
    const auto report = packing::report(progress.packing);
    job.report(packing_json(*set, tag(), report, PackingSource::filling));
    job.log.say(
        fmt::format("{}: {} elements, {}, {:.1f} s", tag(), report.count, packing_words(report), report.seconds));
  }

 protected:
  virtual void go_on(packing::Packing& packing) = 0;

 private:
  void place(Domain& domain, PackingInProgress& progress) {
    const std::size_t count = progress.packing.position.size(), before = static_cast<std::size_t>(progress.rows);
    if (count > before) {
      if (progress.first_row + progress.rows != domain.size())
        refuse(
            at(),
            fmt::format("other elements were made since set '{}' was begun: finish one packing before the next", *set));
      add_rows(domain, *set, count - before);
      progress.rows = static_cast<Index>(count);
    }
    shape(domain, progress.first_row, progress.packing.position, progress.packing.radius, progress.density);
  }
};

}  // namespace beadwork
