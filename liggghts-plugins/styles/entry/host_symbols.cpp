// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the relocations of a loaded library: a call that the loader binds has one, a call bound by the linker has none.
#include "styles/entry/host_symbols.h"

#include <link.h>

#include <algorithm>
#include <set>

namespace eccentra::styles {
namespace {

/// The dynamic section of one loaded library.
struct Tables {
  const char* names = nullptr;
  const ElfW(Sym) * symbols = nullptr;
  const ElfW(Rela) * calls = nullptr; ///< of the procedure linkage table
  std::size_t calls_size = 0;
  const ElfW(Rela) * data = nullptr; ///< of the global offset table, which -fno-plt calls through
  std::size_t data_size = 0;
  bool symbolic = false;
};

/// What lies at an address of this process, which the loader gives as a number.
template <class Type> const Type* pointer_to(ElfW(Addr) address) {
  return reinterpret_cast<const Type*>(address); // NOLINT(performance-no-int-to-ptr)
}

Tables tables_of(const ElfW(Dyn) * entry, ElfW(Addr) base) {
  Tables tables;
  // glibc has relocated these addresses; a loader that has not leaves offsets.
  const auto at = [base](ElfW(Addr) value) { return value < base ? base + value : value; };
  for (; entry->d_tag != DT_NULL; ++entry)
    switch (entry->d_tag) {
    case DT_STRTAB:
      tables.names = pointer_to<char>(at(entry->d_un.d_ptr));
      break;
    case DT_SYMTAB:
      tables.symbols = pointer_to<ElfW(Sym)>(at(entry->d_un.d_ptr));
      break;
    case DT_JMPREL:
      tables.calls = pointer_to<ElfW(Rela)>(at(entry->d_un.d_ptr));
      break;
    case DT_PLTRELSZ:
      tables.calls_size = entry->d_un.d_val / sizeof(ElfW(Rela));
      break;
    case DT_RELA:
      tables.data = pointer_to<ElfW(Rela)>(at(entry->d_un.d_ptr));
      break;
    case DT_RELASZ:
      tables.data_size = entry->d_un.d_val / sizeof(ElfW(Rela));
      break;
    case DT_SYMBOLIC:
      tables.symbolic = true;
      break;
    case DT_FLAGS:
      tables.symbolic = tables.symbolic || (entry->d_un.d_val & DF_SYMBOLIC) != 0;
      break;
    default:
      break;
    }
  return tables;
}

struct Search {
  ElfW(Addr) inside;
  Tables tables;
};

int find_library(dl_phdr_info* info, std::size_t /*size*/, void* search) {
  auto& found = *static_cast<Search*>(search);
  const auto* first = info->dlpi_phdr;
  const auto* last = first + info->dlpi_phnum;
  const bool here = std::any_of(first, last, [&](const ElfW(Phdr) & part) {
    const auto begin = info->dlpi_addr + part.p_vaddr;
    return part.p_type == PT_LOAD && found.inside >= begin && found.inside < begin + part.p_memsz;
  });
  if (!here)
    return 0;
  const auto* dynamic = std::find_if(first, last, [](const ElfW(Phdr) & part) { return part.p_type == PT_DYNAMIC; });
  if (dynamic != last)
    found.tables = tables_of(pointer_to<ElfW(Dyn)>(info->dlpi_addr + dynamic->p_vaddr), info->dlpi_addr);
  return 1;
}

} // namespace

std::vector<std::string> bound_inside(const void* inside, const std::vector<std::string>& functions) {
  Search search{reinterpret_cast<ElfW(Addr)>(inside), {}};
  dl_iterate_phdr(find_library, &search);
  const Tables& t = search.tables;
  if (!t.names || !t.symbols)
    return {};
  if (t.symbolic)
    return functions;
  std::set<std::string> through_the_loader;
  const auto collect = [&](const ElfW(Rela) * first, std::size_t count) {
    for (const ElfW(Rela)* entry = first; first && entry != first + count; ++entry)
      if (const auto symbol = ELF64_R_SYM(entry->r_info))
        through_the_loader.insert(t.names + t.symbols[symbol].st_name);
  };
  collect(t.calls, t.calls_size);
  collect(t.data, t.data_size);
  std::vector<std::string> bound;
  for (const std::string& function : functions)
    if (through_the_loader.count(function) == 0)
      bound.push_back(function);
  return bound;
}

} // namespace eccentra::styles
