# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
eccentra_reported(contacts ROWS grain_in_groove LIBRARIES eccentra liggghts_host)
