#pragma once
// Growth of the tensile strength of concrete with the strain rate.
//
// Source: fib Model Code 2010, 5.1.11.2: f_ct,imp/f_ct = (rate/1e-6)^0.018 up to 10 1/s, then
// 0.0062 (rate/1e-6)^(1/3), with rate in 1/s and 1e-6 1/s the static one. The two branches miss each other by
// 0.07 % at 10 1/s; here the second begins where it exceeds the first one's last value. Below 1e-6 1/s: 1.
// Stated there for rates up to 300 1/s. Theory: docs/theory/rate_factor.md.

namespace fissura::laws {

/// Factor on the tensile strength at a strain rate [1/s]; never below 1.
double rate_factor_mc2010(double rate) noexcept;

} // namespace fissura::laws
