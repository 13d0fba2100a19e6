// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// An animated PNG: the image data of each picture, with numbered controls between them.
#include "report/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace eccentra::report {
namespace {

namespace fs = std::filesystem;

const std::string kSignature = "\x89PNG\r\n\x1a\n";
constexpr std::size_t kHeaderBytes = 13; // of IHDR: width and height, four bytes each, and five more

/// A chunk of a PNG: four letters and its bytes.
struct Chunk {
  std::string kind;
  std::string bytes;
};

std::string big_endian(std::uint32_t value, int bytes) {
  std::string text;
  for (int k = bytes - 1; k >= 0; --k)
    text += static_cast<char>((value >> (8 * k)) & 0xFFU);
  return text;
}

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value = (value << 8U) | static_cast<unsigned char>(bytes.at(at + k));
  return value;
}

/// The check sum of PNG's chunks (ISO 3309).
std::uint32_t check_sum(const std::string& bytes) {
  std::uint32_t sum = 0xFFFFFFFFU;
  for (const char c : bytes) {
    sum ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit)
      sum = (sum & 1U) != 0 ? (sum >> 1U) ^ 0xEDB88320U : sum >> 1U;
  }
  return ~sum;
}

std::string text_of(const Chunk& chunk) {
  const std::string body = chunk.kind + chunk.bytes;
  return big_endian(static_cast<std::uint32_t>(chunk.bytes.size()), 4) + body + big_endian(check_sum(body), 4);
}

std::vector<Chunk> chunks_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  constexpr std::size_t around = 12; // length, letters and check sum
  std::vector<Chunk> chunks;
  std::size_t at = kSignature.size();
  if (bytes.compare(0, at, kSignature) == 0)
    while (at + around <= bytes.size()) {
      const std::size_t length = number_at(bytes, at);
      if (length > bytes.size() - at - around)
        break;
      chunks.push_back({bytes.substr(at + 4, 4), bytes.substr(at + 8, length)});
      at += length + around;
    }
  if (chunks.empty() || chunks.front().kind != "IHDR" || chunks.front().bytes.size() != kHeaderBytes)
    throw std::runtime_error(file.string() + ": is not a PNG file");
  return chunks;
}

/// fcTL: one picture of the whole size, in the place of the one before it.
std::string control(std::uint32_t number, const std::string& header, double seconds) {
  constexpr std::uint32_t per_second = 1000;
  const auto milliseconds = static_cast<std::uint32_t>(std::lround(std::clamp(seconds, 0.001, 60.0) * per_second));
  return big_endian(number, 4) + header.substr(0, 8) + big_endian(0, 4) + big_endian(0, 4) +
         big_endian(milliseconds, 2) + big_endian(per_second, 2) + big_endian(0, 2);
}

} // namespace

void write_film(const std::vector<fs::path>& pictures, double seconds, const fs::path& file) {
  std::string film = kSignature;
  std::string header;
  std::uint32_t number = 0;
  for (const fs::path& picture : pictures) {
    const std::vector<Chunk> chunks = chunks_of(picture);
    const bool first = header.empty();
    if (first) {
      header = chunks.front().bytes;
      constexpr std::uint32_t for_ever = 0;
      film += text_of(chunks.front()) +
              text_of({"acTL", big_endian(static_cast<std::uint32_t>(pictures.size()), 4) + big_endian(for_ever, 4)});
    }
    if (chunks.front().bytes != header)
      throw std::runtime_error(picture.string() + ": is not of the size of the first picture of the film");
    film += text_of({"fcTL", control(number++, header, seconds)});
    for (const Chunk& chunk : chunks)
      if (chunk.kind == "IDAT")
        film += first ? text_of(chunk) : text_of({"fdAT", big_endian(number++, 4) + chunk.bytes});
  }
  film += text_of({"IEND", ""});
  std::ofstream stream(file, std::ios::binary);
  stream << film;
  stream.close();
  if (!stream)
    throw std::runtime_error(file.string() + ": cannot be written: check the folder and the space on the disk");
}

} // namespace eccentra::report
