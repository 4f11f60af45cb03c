// Terms of transport in the J integral and in stress intensities: free strain and the pressure of water in pores.
//
// With F = lambda F_law and Psi the energy by undeformed volume, and with p the pressure, b Biot's coefficient and S
// the storage, the density
//   H = Psi(F, lambda) - p b e - S p^2 / 2,   dH/dF = the total stress,   dH/dp = -(b e + S p) = -zeta,
// depends on the place through lambda and p too, so that by the balance of momentum (Eshelby's force on a gradient)
//   J_k = int [H n_k - sigma_ij n_j u_i,k] ds + int [(sigma'_ii - 3 Psi) lambda,k / lambda + zeta p,k] dA,
// sigma the total stress and sigma' that of the law. For small strains the first is int sigma'_ij d e^free_ij / dx_k dA
// of thermoelastic fracture. zeta is the water that a volume has taken in. Where no water moves it does not vary, H is
// the energy at constant content and needs no area; where water flows p has no singularity at the tip, and J is the
// energy released at the pressure that is there. S p^2 / 2 is left out then: a function of p alone gives to the contour
// what it takes from the area, and where pressures are high that is a small difference of large numbers. The mean of
// zeta is carried by the contour: int p,k dA = int p n_k ds.
//
// Stress intensities feel both as a strain e* that brings no stress, by int sigma^aux_ij d e*_ij / dx_1 dA: with
// drained constants e* = lambda - 1 + b p / (3 K); in a material that water cannot flow through with the undrained
// constants, K_u = K + b^2 / S, and e* = (K (lambda - 1) + b zeta / (3 S)) / K_u.
//
// Weak: strains of the pores are small; water that flows, but less far than a cell, is taken as drained by the split.
// Source: J. R. Rice (1968), J. Appl. Mech. 35, 379-386; W. K. Wilson, I.-W. Yu (1979), Int. J. Fract. 15, 377-387;
// J. R. Rice, M. P. Cleary (1976), Rev. Geophys. 14, 227-241 (undrained constants).
#pragma once

#include "mpm/crack/elastic_constants.hpp"
#include "mpm/math/tensor.hpp"
#include "mpm/transport/definition.hpp"

namespace mpm {

/// Constants of a set of particles.
struct TipPhysics {
  int pressure = -1;  ///< place in ParticleSet::brought; negative: no water
  TransportMaterial pores;
  double bulk = 0.0;       ///< drained K [Pa]; 0: the material has no such constants
  bool undrained = false;  ///< no water flows
  bool expands = false;    ///< has a free strain

  bool any() const { return pressure >= 0 || expands; }
  /// b e [1].
  double squeezed(const Matrix3<double>& f, double j) const;
  /// e* of stress intensities [1], of a small change: `water` [Pa], `content` zeta [1], `free` lambda - 1.
  double eigenstrain(double water, double content, double free) const;
};

/// Constants of a material whose pores no water can leave: K_u = K + b^2 / S, with the same G.
ElasticConstants undrained(const ElasticConstants& drained, const TransportMaterial& pores);

/// True if no water flows through pores.
bool closed(const TransportMaterial& pores);

}  // namespace mpm
