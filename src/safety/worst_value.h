#pragma once

namespace mocha {

/// The worst of value(t) over the stretch that begins at `from_s` and lasts while it is worse than
/// the limit, `until_s` at most; for reports: it is looked at every 5 ms. `worse` is std::less or
/// std::greater.
template <typename Value, typename Worse>
double worst_value(const Value& value, Worse worse, double limit, double from_s, double until_s) {
  constexpr double kStep_s = 5e-3;
  double worst = value(from_s);
  for (double t = from_s + kStep_s; t < until_s; t += kStep_s) {
    const double here = value(t);
    if (!worse(here, limit)) break;
    if (worse(here, worst)) worst = here;
  }
  return worst;
}

}  // namespace mocha
