// Ranges of what a definition says, by the tables of its sections.
#include "mpm/bed/bed_keys.hpp"
#include "mpm/crack/crack_keys.hpp"
#include "mpm/rules/section_keys.hpp"
#include "mpm/sleep/sleep_keys.hpp"
#include "mpm/transport/transport_keys.hpp"

namespace mpm {
namespace {

using Fault = std::optional<KeyFault>;

/// Fault of a part, with the path of its section.
template <class T>
Fault fault_of(const KeyTable<T>& table, const T& part) {
  Fault fault = table.fault(part);
  if (fault) fault->key = table.section() + "." + fault->key;
  return fault;
}

Fault cracks_fault(const CracksDefinition& cracks) {
  if (!cracks.any()) return {};
  if (Fault fault = fault_of(cracks_keys(), cracks)) return fault;
  if (Fault fault = fault_of(contour_keys(), cracks.contour)) return fault;
  for (const CrackDefinition& crack : cracks.list) {
    if (Fault fault = fault_of(face_keys(), crack.faces)) return fault;
  }
  return {};
}

Fault transport_fault(const TransportDefinition& transport) {
  for (const QuantityDefinition& quantity : transport.quantities) {
    if (Fault fault = fault_of(quantity_keys(), quantity)) return fault;
    for (const ToolHeatDefinition& tool : quantity.tools) {
      if (Fault fault = fault_of(tool_heat_keys(), tool)) return fault;
    }
  }
  return {};
}

}  // namespace

std::optional<KeyFault> keys_fault(const SimulationDefinition& definition) {
  if (Fault fault = fault_of(time_keys(), definition.time)) return fault;
  if (Fault fault = fault_of(contact_keys(), definition.contact)) return fault;
  if (Fault fault = cracks_fault(definition.cracks)) return fault;
  if (Fault fault = transport_fault(definition.transport)) return fault;
  if (definition.bed) {
    if (Fault fault = fault_of(bed_keys(), *definition.bed)) return fault;
  }
  return definition.sleep ? fault_of(sleep_keys(), *definition.sleep) : Fault();
}

}  // namespace mpm
