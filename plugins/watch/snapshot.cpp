#include "core/base/text.hpp"
#include "core/plugin/kinds.hpp"

namespace beadwork {

/// Records fields of elements and bonds as a frame of run.h5.
class Snapshot final : public Watcher {
 public:
  static constexpr const char* about =
      "Records fields of elements and bonds as a frame of run.h5, for ParaView and h5py";
  Param<std::vector<std::string>> fields{this,
                                         {.name = "fields",
                                          .doc = "Names of the fields, of elements and of bonds alike, or 'all'; id, "
                                                 "position, radius, and ends and state of the bonds are always there",
                                          .fallback = "position",
                                          .role = Role::fields}};
  Param<bool> picture{
      this, {.name = "picture", .doc = "Whether the report draws these frames in any case", .fallback = "no"}};
  Param<std::vector<std::string>> view{
      this,
      {.name = "view",
       .doc = "Axes along which the report looks at these frames, such as 'z y'; where absent, at an interface or "
              "a crack from its edge, else at the broadest face",
       .optional = true,
       .choices = {"x", "y", "z"}}};

  void look(Sight& sight) override { sight.frame({*fields, *picture, view.given() ? join(*view, " ") : ""}); }
};

}  // namespace beadwork
