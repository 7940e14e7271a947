#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace strutt {

/// A member of an archive whose size is known before its bytes.
struct ZipMember {
  std::string name;
  std::uint64_t size = 0;
};

/// Where everything stands in a ZIP archive of uncompressed members, and the bytes around the data. The
/// checksums are wanted only at the end: data first, headers afterwards, each at its place. Sizes and offsets
/// from `limit` on go into ZIP64 fields.
class ZipLayout {
 public:
  static constexpr std::uint64_t kLimit = 0xFFFFFFFF;
  explicit ZipLayout(std::vector<ZipMember> members, std::uint64_t limit = kLimit);

  std::size_t count() const { return members_.size(); }
  std::uint64_t header_offset(std::size_t member) const { return offsets_[member]; }
  std::uint64_t data_offset(std::size_t member) const;
  std::uint64_t directory_offset() const { return directory_offset_; }

  std::string local_header(std::size_t member, std::uint32_t crc) const;
  /// Central directory and end records; one checksum per member.
  std::string directory(const std::vector<std::uint32_t>& crcs) const;

 private:
  bool is_large(std::uint64_t value) const { return value >= limit_; }
  std::uint64_t local_header_size(std::size_t member) const;
  std::string directory_entry(std::size_t member, std::uint32_t crc) const;
  std::string end_records(std::uint64_t directory_size) const;

  std::vector<ZipMember> members_;
  std::uint64_t limit_;
  std::vector<std::uint64_t> offsets_;
  std::uint64_t directory_offset_ = 0;
};

}  // namespace strutt
