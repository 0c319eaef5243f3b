#pragma once
// A curve of a run: the file, and the row that a watcher hands over.

#include "core/loop/run.hpp"

namespace beadwork {

struct Run::OpenCurve final : CurveSink {
  OpenCurve(Curve c, const Moment& m) : curve(std::move(c)), moment(m) {}
  void row(std::span<const Real> values) override {
    std::vector<Real> all{moment.time};
    all.insert(all.end(), values.begin(), values.end());
    curve.add(moment.step, all);
  }
  Curve curve;
  const Moment& moment;
};

}  // namespace beadwork
