#pragma once
#include "fissura/model/case.hpp"

namespace fissura::loads {

/// Value of a curve at `t` seconds after its stage began; 0 for t < 0, the last value beyond its end.
double value_at(model::Curve const& curve, double t);

/// Time after which a curve no longer changes [s].
double length_of(model::Curve const& curve);

/// 10 x^3 - 15 x^4 + 6 x^5 clamped to [0, 1]: rises with zero slope and curvature at both ends.
double smooth_step(double x);

} // namespace fissura::loads
