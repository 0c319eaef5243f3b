#include "core/loop/forces.hpp"

#include "core/loop/blame.hpp"

namespace beadwork {

void Forces::evaluate(bool settle, bool offering) {
  Domain& domain = state_.domain();
  if (state_.laws.empty()) domain.clear_loads();
  act({true, settle, offering, state_.mover().in_single(), false, settle ? state_.moment.time_step : 0});
  domain.gather();
  for (Load* load : state_.stage().loads) blaming(*load, state_.moment, [&] { load->push(domain, state_.moment); });
}

void Forces::offer() {
  const LoadsAside aside(state_.domain());
  act({true, false, true, state_.mover().in_single()});
}

void Forces::act(Evaluation how) {
  if (how.sections) state_.domain().clear_sums();
  for (const auto& [law, table] : state_.laws) {
    how.sums = how.sections && state_.scene.summing.contains(law);
    blaming(*law, state_.moment, [&, law = law, table = table] { law->act(state_.domain(), *table, how); });
    how.clear = false;
  }
  if (!how.sections) return;
  state_.domain().gather_sums();
  offered_.note_told();
}

}  // namespace beadwork
