// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// OpenFOAM v1912 computes the digest of a dictionary by a stream that takes no single characters, which g++ 14's
// library writes: on Debian 13 a run with any function object, of any solver, ends. The program's definition stands in
// front of that of libOpenFOAM.
#include "OStringStream.H"
#include "SHA1.H"
#include "dictionary.H"

#if OPENFOAM < 2412
Foam::SHA1Digest Foam::dictionary::digest() const {
  OStringStream text;
  for (const entry& e : *this)
    text << e;
  return SHA1(text.str()).digest();
}
#endif
