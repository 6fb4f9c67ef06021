// The mechanics of the caster: figure A.2.
#include <stickslip/base/units.hpp>
#include <stickslip/friction/caster.hpp>

#include "reproduction/figures.hpp"

namespace stickslip::detail {

ThesisFigure figure_a_2(Thesis&) {
  ThesisFigure figure{
      "A.2",
      "Lateral force of a caster and its decay length, against its geometry (trail l, "
      "wheel width w). Dashed: as printed, (A.16) and 3l; solid: with the complete moment of the contact "
      "line. The printed force rises with l/w; the corrected one falls.",
      ""};
  const auto corrected = [](double trail) { return Caster::from_geometry(1, trail, 1); };
  const auto printed = [](double trail) { return Caster::from_geometry_thesis(1, trail, 1); };
  const auto force = [](const Caster& caster) { return caster.slip_level() / standard_gravity; };
  const std::vector<double> geometry = geometric(0.02, 2, 100);
  ThesisPanel forces{"Force", "$\\ell/w$", "$F_n/\\mu N$"},
      lengths{"Slip length", "$\\ell/w$", "$reach/\\ell$", false, true};
  forces.curves.push_back(curve("(A.16)", Kind::thesis, geometry, [&](double l) { return force(printed(l)); }));
  forces.curves.push_back(curve("corrected", Kind::exact, geometry, [&](double l) { return force(corrected(l)); }));
  lengths.curves.push_back(curve("(A.20)", Kind::thesis, geometry, [&](double l) { return printed(l).reach() / l; }));
  lengths.curves.push_back(
      curve("corrected", Kind::exact, geometry, [&](double l) { return corrected(l).reach() / l; }));
  forces.y_limits = {0, 1.05};
  for (ThesisPanel* panel : {&forces, &lengths}) figure.panels.push_back(std::move(*panel));

  figure.statements.push_back(at_least("A.1", "force for l/w = 0.3 as a fraction of μN: \"over 90 %\"", 0.9,
                                       {force(corrected(0.3))},
                                       "the moment of the contact line in (A.12) lacks a term"));
  figure.statements.push_back(at_least("(A.25)", "F_n ≈ μN for l/w from 0.5 to 2: minimum force as a fraction of μN",
                                       0.9, {force(corrected(2))}, "46 % at 0.5, 12 % at 2"));
  figure.statements.push_back(at_most("A.1", "the force is a \"small fraction\" for l/w < 0.1: at 0.1, by (A.16)", 0.5,
                                      {force(printed(0.1))},
                                      "the printed formula contradicts it, and so does the corrected one: 94 %"));
  figure.statements.push_back(
      about("(A.20)", "reach in units of the trail, l/w = 0.5", 3, 0.05, {corrected(0.5).reach() / 0.5}));
  return figure;
}

}  // namespace stickslip::detail
