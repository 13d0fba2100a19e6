// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer's way into the decoder (CMake option ECCENTRA_FUZZ): inputs as whole messages, and as bodies behind a valid
// header, so that what lies behind the header is reached, too.
#include "link/wire_samples.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace eccentra::link;
  constexpr unsigned kKinds = static_cast<unsigned>(wire::kLastKind);
  constexpr std::size_t kLengthAt = wire::kHeaderBytes - sizeof(std::uint64_t);
  (void)eccentra::test::accepted(reinterpret_cast<const std::byte*>(data), size);
  if (size == 0)
    return 0;
  wire::Bytes message = wire::encode_bare(static_cast<wire::Kind>(1 + data[0] % kKinds));
  const auto* body = reinterpret_cast<const std::byte*>(data + 1);
  const std::uint64_t length = size - 1;
  std::memcpy(message.data() + kLengthAt, &length, sizeof length);
  message.insert(message.end(), body, body + length);
  message.shrink_to_fit();
  (void)eccentra::test::accepted(message.data(), message.size());
  return 0;
}
