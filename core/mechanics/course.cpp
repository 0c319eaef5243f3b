#include "core/mechanics/course.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace beadwork {

namespace {

constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();
constexpr Real eps = std::numeric_limits<Real>::epsilon();

// Gauss-Legendre, 16 points: half of the nodes and weights on [-1, 1], the other half lies mirrored.
struct Node {
  Real x, weight;
};
constexpr Node nodes[] = {
    {0.0950125098376374402, 0.1894506104550684963}, {0.2816035507792589132, 0.1826034150449235889},
    {0.4580167776572273863, 0.1691565193950025382}, {0.6178762444026437484, 0.1495959888165767321},
    {0.7554044083550030339, 0.1246289712555338720}, {0.8656312023878317439, 0.0951585116824927848},
    {0.9445750230732325761, 0.0622535239386478929}, {0.9894009349916499326, 0.0271524594117540949}};

// f(time, weight) at the nodes between two times.
template <class F>
void each_node(Real begin, Real end, const F& f) {
  const Real middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
  for (const Node& node : nodes) {
    f(middle - half * node.x, half * node.weight);
    f(middle + half * node.x, half * node.weight);
  }
}

// Octaves of time, so that what is early is seen finely, whatever the time scale of the deck; a few panels in each.
constexpr Real first_octave = 0x1p-40;  // 1e-12 s; its first panel is taken as it comes
constexpr int panels_of_octave = 16;
constexpr Real narrowest = 0x1p-50;  // of the time: a jump is enclosed to rounding
constexpr std::size_t most_panels = std::size_t{1} << 20;

}  // namespace

VelocityCourse::VelocityCourse(OfTime velocity, OfTime acceleration, std::vector<Real> kinks, OfTime noise)
    : velocity_(std::move(velocity)),
      acceleration_(std::move(acceleration)),
      noise_(std::move(noise)),
      kinks_(std::move(kinks)) {
  recent_.fill({nan, {}});
}

PrescribedMotion VelocityCourse::at(Real t) const {
  const std::lock_guard alone(asked_);
  for (const Known& known : recent_)
    if (known.time == t) return known.motion;
  const PrescribedMotion motion = found(t);
  recent_[oldest_] = {t, motion};
  oldest_ = (oldest_ + 1) % recent_.size();
  return motion;
}

PrescribedMotion VelocityCourse::found(Real t) const {
  if (t < 0) return {0, velocity_(0), 0};
  const Real velocity = velocity_(t), acceleration = acceleration_(t);
  if (!(t > 0)) return {0, velocity, acceleration};
  follow(t);
  const auto panel = std::upper_bound(ends_.begin(), ends_.end(), t) - ends_.begin();
  const Real begin = panel == 0 ? 0 : ends_[static_cast<std::size_t>(panel) - 1];
  const Real before = panel == 0 ? 0 : travelled_[static_cast<std::size_t>(panel) - 1];
  return {before + (t > begin ? integral({begin, t}) : 0), velocity, acceleration};
}

// Sums panels up to the one in which t lies; none behind one in which there is no velocity.
void VelocityCourse::follow(Real t) const {
  while ((ends_.empty() || ends_.back() <= t) && (travelled_.empty() || std::isfinite(travelled_.back()))) {
    if (ends_.size() >= most_panels)
      throw std::runtime_error("the velocity changes too often: it cannot be followed that far");
    if (open_.empty()) plan_next_octave();
    const Panel next = open_.back();
    open_.pop_back();
    settle(next);
  }
}

void VelocityCourse::plan_next_octave() const {
  const Panel octave{planned_, planned_ == 0 ? first_octave : 2 * planned_};
  if (!std::isfinite(octave.end)) throw std::runtime_error("the time is out of range");
  planned_ = octave.end;
  divide(octave);
}

// At even times, and where the velocity is known to jump or bend.
void VelocityCourse::divide(const Panel& octave) const {
  std::vector<Real> borders;
  for (int k = 0; k <= panels_of_octave; ++k)
    borders.push_back(octave.begin + (octave.end - octave.begin) * k / panels_of_octave);
  for (const Real kink : kinks_)
    if (kink > octave.begin && kink < octave.end) borders.push_back(kink);
  std::sort(borders.begin(), borders.end());
  borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  for (std::size_t k = borders.size() - 1; k > 0; --k) open_.push_back({borders[k - 1], borders[k]});
}

// The panel is fine enough if two parts of it give the same, but for rounding: of velocities, which may be small differences
// of large terms, of times as far as the velocity changes with them, and of the place. The parts are uneven, lest many whole periods look like rest: there all
// that is odd about the middle gives 0, and so do its halves.
void VelocityCourse::settle(const Panel& panel) const {
  constexpr Real uneven = 0.41421356;
  const Real cut = panel.begin + uneven * (panel.end - panel.begin), middle = 0.5 * (panel.begin + panel.end);
  const Sum whole = weighed(panel);
  const Real parts = integral({panel.begin, cut}) + integral({cut, panel.end});
  const bool agree = std::abs(whole.value - parts) <= eps * (4 * whole.way + whole.noise + 0.25 * way_);
  if (agree || panel.begin == 0 || panel.end - panel.begin <= narrowest * panel.end) {
    travelled_.push_back((travelled_.empty() ? 0 : travelled_.back()) + parts);
    ends_.push_back(panel.end);
    way_ += whole.way;
    return;
  }
  open_.push_back({middle, panel.end});
  open_.push_back({panel.begin, middle});
}

Real VelocityCourse::integral(const Panel& panel) const {
  Real sum = 0;
  each_node(panel.begin, panel.end, [&](Real t, Real weight) { sum += weight * velocity_(t); });
  return sum;
}

VelocityCourse::Sum VelocityCourse::weighed(const Panel& panel) const {
  Sum sum{0, 0, 0};
  each_node(panel.begin, panel.end, [&](Real t, Real weight) {
    const Real velocity = velocity_(t), noise = noise_ ? 2 * noise_(t) : std::abs(t * acceleration_(t));
    sum.value += weight * velocity;
    sum.way += weight * std::abs(velocity);
    if (std::isfinite(noise)) sum.noise += weight * noise;
  });
  return sum;
}

}  // namespace beadwork
