# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
# cpack makes a .deb of the launcher, libraries, solver, tools and docs.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME eccentra)
set(CPACK_PACKAGE_CONTACT "Eccentra contributors")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "liggghts, openfoam, openmpi-bin")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
include(CPack)
