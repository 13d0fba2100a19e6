// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reaches a private member by explicit template instantiation, which the language exempts from access checks.
// (Never `#define private public`: it changes the meaning of standard headers.)
#pragma once

namespace eccentra::styles {

/// Holds the pointer to member that PrivateMember publishes under Tag.
template <class Tag> struct Published { static typename Tag::type pointer; };
template <class Tag> typename Tag::type Published<Tag>::pointer;

/// Instantiate explicitly as `template struct PrivateMember<Tag, &Class::member>;`.
template <class Tag, typename Tag::type member> struct PrivateMember {
  PrivateMember() { Published<Tag>::pointer = member; }
  static PrivateMember instance;
};
template <class Tag, typename Tag::type member> PrivateMember<Tag, member> PrivateMember<Tag, member>::instance;

} // namespace eccentra::styles
