#include "mpm/choice/method_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "mpm/math/nearest.hpp"

namespace mpm::choice {
namespace {

constexpr Transfer kFlip = {TransferKind::flip, 1.0, 2};

/// Transfers that are charted beside FLIP.
const std::vector<Transfer>& other_transfers() {
  static const std::vector<Transfer> list = {{TransferKind::flip, 0.99, 2}, {TransferKind::flip, 0.0, 2},
                                             {TransferKind::xpic, 1.0, 2},  {TransferKind::xpic, 1.0, 3},
                                             {TransferKind::fmpm, 1.0, 2},  {TransferKind::fmpm, 1.0, 3},
                                             {TransferKind::fmpm, 1.0, 5},  {TransferKind::apic, 1.0, 2}};
  return list;
}

}  // namespace

std::string transfer_label(const Transfer& transfer) {
  switch (transfer.kind) {
    case TransferKind::flip:
      if (transfer.flip == 1.0) return "flip";
      if (transfer.mixes() || transfer.every > 1) {
        return fmt::format("flip{:g}xpic{}every{}", transfer.flip, transfer.mixed, transfer.every);
      }
      return transfer.flip == 0.0 ? "pic" : fmt::format("flip{:g}", transfer.flip);
    case TransferKind::apic:
      return "apic";
    case TransferKind::xpic:
    case TransferKind::fmpm:
      break;
  }
  return fmt::format("{}{}", kTransferNames[static_cast<int>(transfer.kind)], transfer.order);
}

MethodChoice choose(ShapeKind shape, UpdateScheme update, const Transfer& transfer, Precision precision) {
  MethodChoice choice;
  choice.label = fmt::format("{}/{}/{}{}", shape_name(shape), kUpdateNames[static_cast<int>(update)],
                             transfer_label(transfer), precision == Precision::float32 ? "/single" : "");
  choice.method.shape = shape;
  choice.method.update = update;
  choice.method.transfer = transfer;
  choice.method.precision = precision;
  return choice;
}

std::vector<MethodChoice> charted_methods() {
  std::vector<MethodChoice> list = {choose(ShapeKind::ugimp, UpdateScheme::usf, kFlip)};
  for (const ShapeTraits& shape : kShapeTraits) {
    for (const UpdateScheme update : {UpdateScheme::usavg, UpdateScheme::usf, UpdateScheme::usl}) {
      if (shape.kind != ShapeKind::ugimp || update != UpdateScheme::usf)
        list.push_back(choose(shape.kind, update, kFlip));
    }
  }
  for (const ShapeKind shape : {ShapeKind::ugimp, ShapeKind::cpdi}) {
    for (const Transfer& transfer : other_transfers()) list.push_back(choose(shape, UpdateScheme::usavg, transfer));
  }
  list.push_back(choose(ShapeKind::bspline2, UpdateScheme::usavg, {TransferKind::apic, 1.0, 2}));
  list.push_back(choose(ShapeKind::bspline2, UpdateScheme::usavg, {TransferKind::fmpm, 1.0, 2}));
  list.push_back(choose(ShapeKind::ugimp, UpdateScheme::usavg, kFlip, Precision::float32));
  return list;
}

std::vector<MethodChoice> main_methods() {
  std::vector<MethodChoice> list;
  for (const MethodChoice& choice : charted_methods()) {
    const MethodDefinition& method = choice.method;
    const bool plain = method.update == UpdateScheme::usavg && transfer_label(method.transfer) == "flip";
    if (plain || method.shape == ShapeKind::ugimp) list.push_back(choice);
  }
  return list;
}

MethodChoice find_method(const std::string& label) {
  std::vector<std::string> labels;
  for (const MethodChoice& choice : charted_methods()) {
    if (choice.label == label) return choice;
    labels.push_back(choice.label);
  }
  const std::string near = nearest(label, labels);
  throw ChoiceError(fmt::format("no method is called '{}'; {}there are {}", label,
                                near.empty() ? "" : "did you mean '" + near + "'? ", fmt::join(labels, ", ")));
}

}  // namespace mpm::choice
