// The work of a step that can be counted without a clock.
#pragma once

#include "mpm/definition/definition.hpp"

namespace mpm::study {

/// Times that a step goes through all pairs of particle and node, to gather or to scatter: USF 4 (momentum, velocity
/// gradient, force, motion), USL 5 (its momentum is scattered twice), USAVG 6 (so is its gradient gathered), and 2 more
/// for each order of XPIC(m) and FMPM(k) above the first; where FLIP is mixed with XPIC in one of several steps, the
/// mean of these. Read off the steps of method reference 5.4 and 6.6.
double passes(UpdateScheme update, const Transfer& transfer);
/// Nodal values of the hat function, or of the spline, that one particle's shape function is made of, in `dim`
/// directions: 2^d Dirac, 3^d for boxes of up to a cell and for quadratic splines, 4^d cubic; of CPDI 2^d for each of
/// 2^d corners, of qCPDI 2^d for each of 3^d points.
int visits(ShapeKind shape, int dim);
/// Counted work of one step of one particle: visits times passes. It knows nothing of what a visit costs, nor of laws,
/// sorting and nodes: the same on every machine, and no more than a measure of size.
double counted_work(const MethodDefinition& method, int dim);

}  // namespace mpm::study
