// A solute that diffuses through a membrane. In the steady state between the potentials a and b the flux is
// c_sat D (a - b) / L, and the potential is linear. Source: exact-solutions 22; Fick's first law.
#include "page.hpp"
#include "transport_run.hpp"

namespace verification {
namespace diffusion_test {

constexpr double kLength = 1e-3, kDiffusivity = 1e-9, kSaturation = 0.2;  // numbers of membrane.yaml

TEST(Diffusion, SteadyMembrane) {
  Page page("transport", "membrane", "A solute through a membrane");
  page.problem(
          "A membrane 1 mm thick that takes up a fifth of its volume at saturation (D = 1e-9 m²/s), 20 cells, between "
          "potentials of 0.8 and 0.3; and with a given flux in at one face and 0.3 at the other. Until D t / L² = 2.")
      .exact("Flux c_sat D Δμ/L, straight profile.", "Fick's first law")
      .scene("membrane");
  const double flux = kSaturation * kDiffusivity * 0.5 / kLength;
  Numbers mm, line;
  for (int i = 0; i <= 20; ++i) mm.push_back(0.05 * i), line.push_back(0.8 - 0.5 * mm.back());
  Panel& panel = page.figure().panel("Steady state", "x [mm]", "potential").exact("straight", mm, line);
  for (const std::string shape : {"ugimp", "cpdi"}) {
    mpm::Simulation held = start("membrane", {"method.shape=" + shape}, 1);
    run_until(held, 2000.0);
    expect_balance(held, "concentration");
    const Numbers x = field(held, "x"), mu = field(held, "concentration");
    const Misfit all = misfit(mu, [&](std::size_t p) { return 0.8 - 0.5 * x[p] / kLength; });
    page.near_absolute("largest error between two potentials, " + shape, 200.0 * all.most, 0.0, 0.5,
                       "% of the difference");
    // Content that it has taken up: the mean potential, 0.55, times the saturation and 1 mm over 1 m^2.
    page.near("content taken up, " + shape, 1e3 * reported(held, "concentration content"),
              1e3 * 0.55 * kSaturation * kLength, 0.005, "litre");
    mpm::Simulation fed =
        start("membrane",
              {"method.shape=" + shape, "transport.concentration.fluxes=[{body: membrane, edge: x_min, flux: 1e-7}]",
               "transport.concentration.values=[{name: dry, region: {box: {min: 1 mm, max: 1.2 mm}}, value: 0.3}]",
               "transport.concentration.initial=0.55"},
              1);
    run_until(fed, 4000.0);
    expect_balance(fed, "concentration");
    const Numbers raised = field(fed, "concentration");
    page.near("difference that the flux needs, " + shape,
              (raised.front() - raised.back()) / (x.back() - x.front()) * kLength, 1e-7 / flux * 0.5, 0.005, "");
    const double before = reported(fed, "concentration by prescribed values");
    run_until(fed, 4200.0);
    page.near("flux out of the other face, " + shape,
              (before - reported(fed, "concentration by prescribed values")) / 200.0 * 1e7, 1.0, 0.005,
              "of what goes in");
    if (shape == "ugimp") continue;
    Numbers at;
    for (const double one : x) at.push_back(1e3 * one);
    panel.points("between potentials", at, mu);
  }
  page.meaning("The flux is the product of saturation, diffusivity and slope; nothing is lost on the way.");
}

}  // namespace diffusion_test
}  // namespace verification
