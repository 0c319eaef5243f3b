#pragma once
// A packing's figures, for summary.json and for the log.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>

#include "core/packing/report.hpp"

namespace beadwork {

/// Where a packing comes from: one that was read has neither seed nor law, and its walls are those of the box around
/// it.
enum class PackingSource { filling, file };

inline std::string packing_json(const std::string& set, const std::string& step, const packing::PackingReport& r,
                                PackingSource source) {
  const bool made = source == PackingSource::filling;
  const std::string seed = made ? fmt::format(R"("seed":{},)", r.seed) : R"("walls":"the box around the elements",)";
  const std::string law = made ? fmt::format(R"("kolmogorov_smirnov_distance":{:.4g},)", r.kolmogorov) : "";
  const std::string around =
      r.around.near > 0
          ? fmt::format(R"("around":{{"near":{},"touching":{},"inside":{},"least_gap":{:.4g},"mean_gap":{:.4g},)"
                        R"("largest_gap":{:.4g}}},)",
                        r.around.near, r.around.touching, r.around.inside, r.around.least_gap, r.around.mean_gap,
                        r.around.largest_gap)
          : "";
  // Where no element is as far as that from walls, nothing can be said of the bulk.
  const std::string bulk =
      r.bulk_count > 0
          ? fmt::format(R"("coordination_bulk":{:.5g},"fabric_eigenvalues_bulk":[{:.5g}],"density_bulk":{:.5g},)",
                        r.near.bulk, fmt::join(r.fabric_bulk, ","), r.density_bulk)
          : "";
  return fmt::format(
      R"({{"set":"{}","step":"{}","elements":{},{}"seconds":{:.3g},)"
      R"("coordination":{:.5g},"coordination_without_rattlers":{:.5g},{})"
      R"("coordination_touching":{:.5g},"coordination_touching_without_rattlers":{:.5g},"gap_tolerance":{},)"
      R"("rattlers":{:.4g},"max_overlap":{:.4g},"mean_overlap":{:.4g},)"
      R"("fabric_eigenvalues":[{:.5g}],"density":{:.5g},)"
      R"("mean_radius":{:.8g},"min_radius":{:.8g},"max_radius":{:.8g},{}{}"bond_order_q6":{:.4g},)"
      R"("crystalline_share":{:.4g},"radius_over_mean":{{"edges":[{:.6g}],"counts":[{}],"unit":"1"}}}})",
      set, step, r.count, seed, r.seconds, r.near.all, r.near.without_rattlers, bulk, r.touching.all,
      r.touching.without_rattlers, r.tolerance, r.rattlers, r.max_overlap, r.mean_overlap, fmt::join(r.fabric, ","),
      r.density, r.mean_radius, r.min_radius, r.max_radius, law, around, r.bond_order, r.crystalline_share,
      fmt::join(r.histogram_edges, ","), fmt::join(r.histogram, ","));
}

/// The contacts of an element, and how full the volume is.
inline std::string packing_words(const packing::PackingReport& r) {
  const std::string bulk = r.bulk_count > 0 ? fmt::format(" ({:.3f} in the bulk)", r.near.bulk) : "";
  const std::string around = r.around.near > 0 ? fmt::format(", {} touch what it surrounds", r.around.touching) : "";
  return fmt::format("Z {:.3f}{}, largest overlap {:.2g}, density {:.4f}{}", r.near.all, bulk, r.max_overlap, r.density,
                     around);
}

}  // namespace beadwork
