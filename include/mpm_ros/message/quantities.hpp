// The lists of what a run reports of a contact, of a pair of bodies, of a crack's tip, of a robot and of its state. A
// line is a number; their order is that of the CSV columns.
#pragma once

#include <mpm_ros/ContactForce.h>
#include <mpm_ros/ContactPair.h>
#include <mpm_ros/CrackTip.h>
#include <mpm_ros/RobotState.h>
#include <mpm_ros/SolverState.h>

#include <string>
#include <vector>

#include "mpm/definition/report.hpp"
#include "mpm/robot/robot_report.hpp"
#include "mpm_ros/message/quantity.hpp"

namespace mpm_ros {

using ContactQuantity = Quantity<mpm::ContactReport, ContactForce>;
using PairQuantity = Quantity<mpm::PairReport, ContactPair>;
using TipQuantity = Quantity<mpm::CrackTipReport, CrackTip>;
using RobotQuantity = Quantity<mpm::RobotReport, RobotState>;
using StateQuantity = Quantity<mpm::SolverState, SolverState>;

/// Quantities of a rigid body's contact with the material; the first is the mean force.
const std::vector<ContactQuantity>& contact_quantities();
/// Quantities of the contact between two deformable bodies; the first is the mean force on the second.
const std::vector<PairQuantity>& pair_quantities();
/// Quantities of a crack's tip as it was last looked at.
const std::vector<TipQuantity>& tip_quantities();
/// Energies of a robot; joints and sensors have names of their own and stand beside these.
const std::vector<RobotQuantity>& robot_quantities();
/// Quantities of the solver; impulses have names of their own and stand beside these.
const std::vector<StateQuantity>& state_quantities();

/// Name among SolverState::values: what the material stores and has dissipated, less the work done on it [J]
/// (mpm::EnergyReport::balance()). Absent where the run does not count all that takes energy.
inline constexpr char kBalance[] = "balance";

/// Name among SolverState::values: commands that came faster than the node took them, and had no effect. Absent where
/// there are none.
inline constexpr char kCommandsDropped[] = "commands dropped";

/// An energy of the state [J], or work done.
struct EnergyFigure {
  std::string key;      ///< in JSON
  std::string heading;  ///< in tables
  double value = 0.0;
};
/// Those of the list, then those that modules bring by names of their own.
std::vector<EnergyFigure> energies_of(const SolverState& state);
std::vector<EnergyFigure> energies_of(const RobotState& robot);

}  // namespace mpm_ros
