#pragma once
// F_inter of Eq. (2): contact with friction between tets that are not joined (bodies that are apart
// from the start, fragments, and cracks whose faces have slid off each other). Theory:
// docs/theory/contact.md.
#include <string>

#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::contact {

/// Looks for the pairs of tets that may touch before the next search. Returns at once while there is one body
/// without parted faces, or while nothing has moved far enough.
void refresh_pairs(model::Model const& m, state::State& s, state::Scratch& w);

/// Forces of all pairs at u_n into the overlay; memories and accounts (contact, contact_friction) move on.
void pair_forces(model::Model const& m, state::State& s, state::Scratch& w);

/// Throws core::InputError with the places where separate bodies overlap at the start by more than a
/// thousandth of a tet. Where [contact] initial_overlap allows that, returns a warning that says how deep
/// they do, or
/// "": each pair of tets then starts without a force (see pair_law).
std::string check_start(model::Model const& m);

} // namespace fissura::contact
