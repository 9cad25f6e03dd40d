// SHA-256 (FIPS 180-4), computed by Nettle.
#pragma once

#include <nettle/sha2.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace nearmiss {

/// The SHA-256 digest of bytes that are added piece by piece.
class Sha256 {
 public:
  Sha256() { sha256_init(&context_); }

  Sha256& add(std::string_view bytes);

  /// The digest of all bytes. Nothing may be added afterwards.
  [[nodiscard]] std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest();
  [[nodiscard]] std::string hex_digest();

 private:
  sha256_ctx context_{};
};

/// Bytes in lower-case hexadecimal, two digits a byte.
std::string hex(std::string_view bytes);

std::string sha256_hex(std::string_view bytes);

}  // namespace nearmiss
