// Contacts of the implicit step: points of rigid bodies and nodes on walls with friction, one after another.
#include "mpm/kernel/soil_contact.hpp"

namespace mpm {

template <class T>
void meet_contacts(const mpm_kernel::SoilBlock<T>& block, mpm_kernel::SoilNode<T>* nodes) {
  for (int i = 0; i < block.wall_count; ++i) soil::touch_wall(block.walls[i], nodes);
  for (int pass = 0; pass < soil::kContactPasses; ++pass) {
    for (int i = 0; i < block.row_count; ++i) soil::touch_row(block.rows[i], nodes);
  }
}

template <class T>
void touch_contact(mpm_kernel::ContactRow<T>& row, mpm_kernel::SoilNode<T>* nodes) {
  soil::touch_row(row, nodes);
}

template void touch_contact(mpm_kernel::ContactRow<double>&, mpm_kernel::SoilNode<double>*);
template void touch_contact(mpm_kernel::ContactRow<float>&, mpm_kernel::SoilNode<float>*);
template void meet_contacts(const mpm_kernel::SoilBlock<double>&, mpm_kernel::SoilNode<double>*);
template void meet_contacts(const mpm_kernel::SoilBlock<float>&, mpm_kernel::SoilNode<float>*);

}  // namespace mpm
