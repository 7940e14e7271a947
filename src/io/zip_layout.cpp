#include "io/zip_layout.hpp"

#include <concepts>

namespace strutt {
namespace {

// Field by field as in the ZIP application note (APPNOTE.TXT 4.3.7, 4.3.12, 4.3.14-16, 4.5.3).
constexpr std::uint32_t kLocalSignature = 0x04034B50;
constexpr std::uint32_t kCentralSignature = 0x02014B50;
constexpr std::uint32_t kEndSignature = 0x06054B50;
constexpr std::uint32_t kEnd64Signature = 0x06064B50;
constexpr std::uint32_t kLocator64Signature = 0x07064B50;
constexpr std::uint16_t kZipVersion = 20;
constexpr std::uint16_t kZipVersion64 = 45;
constexpr std::uint16_t kMadeByUnix = 3 << 8;
constexpr std::uint16_t kUtf8Name = 1 << 11;
constexpr std::uint16_t kExtra64 = 1;
constexpr std::uint16_t kMidnight = 0;
constexpr std::uint16_t kFirstOf1980 = (1 << 5) | 1;  // a fixed date: the same chart gives the same bytes
constexpr std::uint32_t kRegularFileMode = 0100644U << 16;
constexpr std::uint64_t kLocalFixedSize = 30;
constexpr std::uint64_t kLocalExtraSize = 20;

template <std::unsigned_integral T>
void put(std::string& out, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) out += static_cast<char>((value >> (8 * i)) & 0xFF);
}

template <typename... T>
void put_all(std::string& out, T... values) {
  (put(out, values), ...);
}

std::uint16_t short_of(std::uint64_t value) { return static_cast<std::uint16_t>(value); }

}  // namespace

ZipLayout::ZipLayout(std::vector<ZipMember> members, std::uint64_t limit)
    : members_(std::move(members)), limit_(limit) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    offsets_.push_back(directory_offset_);
    directory_offset_ += local_header_size(i) + members_[i].size;
  }
}

std::uint64_t ZipLayout::local_header_size(std::size_t member) const {
  const auto& m = members_[member];
  return kLocalFixedSize + m.name.size() + (is_large(m.size) ? kLocalExtraSize : 0);
}

std::uint64_t ZipLayout::data_offset(std::size_t member) const {
  return offsets_[member] + local_header_size(member);
}

std::string ZipLayout::local_header(std::size_t member, std::uint32_t crc) const {
  const auto& m = members_[member];
  const bool large = is_large(m.size);
  const std::uint32_t size = large ? 0xFFFFFFFF : static_cast<std::uint32_t>(m.size);
  std::string out;
  put_all(out, kLocalSignature, large ? kZipVersion64 : kZipVersion, kUtf8Name, std::uint16_t{0}, kMidnight,
          kFirstOf1980, crc, size, size, short_of(m.name.size()), short_of(large ? kLocalExtraSize : 0));
  out += m.name;
  if (large) put_all(out, kExtra64, std::uint16_t{16}, m.size, m.size);
  return out;
}

std::string ZipLayout::directory_entry(std::size_t member, std::uint32_t crc) const {
  const auto& m = members_[member];
  const std::uint64_t offset = offsets_[member];
  std::string extra;  // only the fields that do not fit, in this order
  if (is_large(m.size)) put_all(extra, m.size, m.size);
  if (is_large(offset)) put(extra, offset);
  const bool large = !extra.empty();
  const std::uint16_t version = large ? kZipVersion64 : kZipVersion;
  const std::uint32_t size = is_large(m.size) ? 0xFFFFFFFF : static_cast<std::uint32_t>(m.size);
  std::string out;
  put_all(out, kCentralSignature, static_cast<std::uint16_t>(kMadeByUnix | version), version, kUtf8Name,
          std::uint16_t{0}, kMidnight, kFirstOf1980, crc, size, size, short_of(m.name.size()),
          short_of(large ? extra.size() + 4 : 0), std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0},
          kRegularFileMode,
          is_large(offset) ? std::uint32_t{0xFFFFFFFF} : static_cast<std::uint32_t>(offset));
  out += m.name;
  if (large) {
    put_all(out, kExtra64, short_of(extra.size()));
    out += extra;
  }
  return out;
}

std::string ZipLayout::end_records(std::uint64_t directory_size) const {
  const std::uint64_t entries = members_.size();
  const bool large = is_large(directory_offset_) || is_large(directory_size);
  std::string out;
  if (large) {
    constexpr std::uint64_t rest_of_record = 44;
    put_all(out, kEnd64Signature, rest_of_record, static_cast<std::uint16_t>(kMadeByUnix | kZipVersion64),
            kZipVersion64, std::uint32_t{0}, std::uint32_t{0}, entries, entries, directory_size,
            directory_offset_);
    put_all(out, kLocator64Signature, std::uint32_t{0}, directory_offset_ + directory_size, std::uint32_t{1});
  }
  put_all(out, kEndSignature, std::uint16_t{0}, std::uint16_t{0}, short_of(entries), short_of(entries),
          large ? std::uint32_t{0xFFFFFFFF} : static_cast<std::uint32_t>(directory_size),
          large ? std::uint32_t{0xFFFFFFFF} : static_cast<std::uint32_t>(directory_offset_),
          std::uint16_t{0});
  return out;
}

std::string ZipLayout::directory(const std::vector<std::uint32_t>& crcs) const {
  std::string out;
  for (std::size_t i = 0; i < members_.size(); ++i) out += directory_entry(i, crcs[i]);
  return out + end_records(out.size());
}

}  // namespace strutt
