// [contact] and [[contact_pair]].
#include <fmt/core.h>

#include "fissura/deck/fields.hpp"

namespace fissura::deck {
namespace {

using model::ContactPairSpec;
using model::ContactSpec;

Section contact_section() {
  Section s =
      single_section("contact", &model::Case::contact,
                     "Contact between bodies, fragments, and crack faces that have slid off each other.");
  Fields<ContactSpec> f(s.keys);
  f.flag("on", &ContactSpec::on, "`false`: what is not joined passes through each other.");
  f.number("friction", &ContactSpec::friction, "Coulomb friction mu between bodies that were never joined.")
      .not_negative()
      .default_is("the smaller `friction` of the two concretes")
      .echoed_if([](ContactSpec const& c) { return c.friction >= 0; });
  f.word("initial_overlap", &ContactSpec::initial_overlap,
         {{"refuse", model::InitialOverlap::refuse}, {"zero", model::InitialOverlap::zero}},
         "Bodies that overlap at the start by more than a thousandth of a tet: `refuse` them, or take that "
         "overlap as "
         "the `zero` of the springs between them, for curved bodies that were meshed apart.");
  return s;
}

void finish_pair(Reader& reader, Node const& table, void* record) {
  auto const& p = *static_cast<ContactPairSpec const*>(record);
  if (reader.good(record, {"materials"}) && p.materials.size() != 2)
    reader.error(table, "`materials` of a [[contact_pair]] names two concretes, e.g. [\"beam\", \"wall\"]");
}

Section pair_section() {
  Section s =
      many_section("contact_pair", &model::Case::contact_pairs, "Friction between bodies of two materials.");
  s.finish = finish_pair;
  Fields<ContactPairSpec> f(s.keys);
  f.texts("materials", &ContactPairSpec::materials,
          "Names of two [[concrete]]; the same twice: two bodies of it.")
      .required();
  f.number("friction", &ContactPairSpec::friction, "Coulomb friction mu.").not_negative().required();
  return s;
}

} // namespace

std::vector<Section> contact_sections() {
  return {contact_section(), pair_section()};
}

} // namespace fissura::deck
