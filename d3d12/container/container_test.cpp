// SPDX-License-Identifier: MIT
#include "d3d12/container/container.h"

#include <cstring>
#include <string>

#include <gmock/gmock.h>

#include "d3d12/com/errors.h"
#include "d3d12/container/checksum.h"

namespace kaamos::d3d12 {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

std::string text_of(const Part& part) {
  return {reinterpret_cast<const char*>(part.bytes.data()), part.bytes.size()};
}

std::vector<std::byte> two_parts() {
  const std::string first = "abcde", second = "xyz!";
  return write_container(
      std::vector<Part>{{fourcc("ONE1"), bytes_of(first)}, {fourcc("TWO2"), bytes_of(second)}});
}

uint32_t word(const std::vector<std::byte>& container, size_t offset) {
  uint32_t out = 0;
  std::memcpy(&out, container.data() + offset, sizeof(out));
  return out;
}

void set_word(std::vector<std::byte>& container, size_t offset, uint32_t value) {
  std::memcpy(container.data() + offset, &value, sizeof(value));
}

// Damage that the checksum does not tell first.
void unsign(std::vector<std::byte>& container) {
  std::memset(container.data() + 4, 0, 16);
}

std::string error_of(const std::vector<std::byte>& container) {
  const auto parts = read_container(container.data(), container.size());
  if (parts) return "";
  EXPECT_EQ(parts.error().id, public_id(ErrorId::kBytecode));
  return parts.error().message;
}

TEST(Container, HasThePartsThatWereWritten) {
  const auto container = two_parts();
  const auto parts = read_container(container.data(), container.size());
  ASSERT_TRUE(parts) << parts.error().message;
  ASSERT_EQ(parts->size(), 2u);
  EXPECT_EQ((*parts)[0].fourcc, fourcc("ONE1"));
  EXPECT_EQ(text_of((*parts)[0]), "abcde");
  EXPECT_EQ((*parts)[1].fourcc, fourcc("TWO2"));
  EXPECT_EQ(text_of((*parts)[1]), "xyz!");
}

TEST(Container, LayoutIsThatOfDxc) {
  const auto container = two_parts();
  EXPECT_EQ(word(container, 0), 0x43425844u);  // DXBC
  EXPECT_EQ(word(container, 20), 1u);          // version 1.0
  // Header, two offsets, part of 8 + 5 bytes, 3 to fill up, part of 8 + 4 bytes.
  EXPECT_EQ(word(container, 24), 32u + 8 + 16 + 12);
  EXPECT_EQ(container.size(), 68u);
  EXPECT_EQ(word(container, 28), 2u);
  EXPECT_EQ(word(container, 32), 40u);
  EXPECT_EQ(word(container, 36), 56u);
  EXPECT_EQ(word(container, 56), fourcc("TWO2"));
  EXPECT_EQ(word(container, 60), 4u);
}

TEST(Container, WithoutPartsIsOne) {
  const auto container = write_container({});
  const auto parts = read_container(container.data(), container.size());
  ASSERT_TRUE(parts);
  EXPECT_TRUE(parts->empty());
}

// D3D's serializer gives this checksum for a root signature without parameters, version 1.0.
TEST(Container, ChecksumOfAnEmptyRootSignatureIsD3ds) {
  const uint32_t body[] = {1, 0, 24, 0, 24, 0};
  const auto container =
      write_container(std::vector<Part>{{fourcc("RTS0"), std::as_bytes(std::span(body))}});
  ASSERT_EQ(container.size(), 68u);
  EXPECT_EQ(word(container, 4), 0xd64afc1du);
  EXPECT_EQ(word(container, 8), 0x5dc27735u);
  EXPECT_EQ(word(container, 12), 0x9edacb4au);
  EXPECT_EQ(word(container, 16), 0x6bd8a7fau);
}

// "CBV(b4, space = 1, visibility = SHADER_VISIBILITY_VERTEX), SRV(t13, flags = DATA_STATIC),
// UAV(u6, flags = DATA_STATIC_WHILE_SET_AT_EXECUTE)", version 1.1: of the 120 bytes behind the
// checksum 56 are left after a whole block, one too many for the lengths to fit in.
TEST(Container, ChecksumWithABlockOfItsOwnForTheLengthIsD3ds) {
  const uint32_t body[] = {2, 3, 24, 0,  96, 0,             // version, parameters, samplers, flags
                           2, 1, 60, 3,  0,  72, 4, 0, 84,  // type, visibility, offset
                           4, 1, 0,  13, 0,  8,  6, 0, 4};  // register, space, flags
  const auto container =
      write_container(std::vector<Part>{{fourcc("RTS0"), std::as_bytes(std::span(body))}});
  ASSERT_EQ(container.size(), 140u);
  EXPECT_EQ(word(container, 4), 0x8ddedbbeu);
  EXPECT_EQ(word(container, 8), 0xbcfea259u);
  EXPECT_EQ(word(container, 12), 0x6b35bfbbu);
  EXPECT_EQ(word(container, 16), 0x23e1de24u);
}

// [RFC 1321: A.5]
TEST(Container, Md5IsThatOfTheStandard) {
  EXPECT_THAT(md5({}), ElementsAre(0xd98c1dd4u, 0x04b2008fu, 0x980980e9u, 0x7e42f8ecu));
  EXPECT_THAT(md5(bytes_of("abc")),
              ElementsAre(0x98500190u, 0xb04fd23cu, 0x7d3f96d6u, 0x727fe128u));
  const std::string digits =
      "12345678901234567890123456789012345678901234567890123456789012345678901234567890";
  EXPECT_THAT(md5(bytes_of(digits)),
              ElementsAre(0xa2f4ed57u, 0x55c9e32bu, 0x2eda49acu, 0x7ab60721u));
}

TEST(Container, EveryChangedByteIsFound) {
  const auto container = two_parts();
  for (size_t i = 0; i < container.size(); ++i) {
    auto changed = container;
    changed[i] ^= std::byte{1};
    EXPECT_NE(error_of(changed), "") << "byte " << i;
  }
}

TEST(Container, EveryCutIsFound) {
  const auto container = two_parts();
  for (size_t size = 0; size < container.size(); ++size) {
    // In memory of exactly that size, so that a sanitizer finds a read behind it.
    EXPECT_NE(error_of({container.begin(), container.begin() + static_cast<ptrdiff_t>(size)}), "")
        << size << " bytes";
  }
}

TEST(Container, ErrorsNameTheOffset) {
  const auto container = two_parts();
  auto changed = container;
  set_word(changed, 0, fourcc("RTS0"));
  EXPECT_THAT(error_of(changed), AllOf(HasSubstr("byte 0"), HasSubstr("\"RTS0\"")));

  changed = container;
  set_word(changed, 24, 1000);
  EXPECT_THAT(error_of(changed), AllOf(HasSubstr("byte 24"), HasSubstr("1000 bytes")));

  changed = container;
  unsign(changed);
  set_word(changed, 28, 0x40000000);  // offsets of 4 GiB
  EXPECT_THAT(error_of(changed), AllOf(HasSubstr("byte 28"), HasSubstr("1073741824 parts")));

  changed = container;
  unsign(changed);
  set_word(changed, 36, 0xFFFFFFFC);
  EXPECT_THAT(error_of(changed), AllOf(HasSubstr("byte 36"), HasSubstr("part 1")));

  changed = container;
  unsign(changed);
  set_word(changed, 60, 5);  // one byte more than is left
  EXPECT_THAT(error_of(changed), AllOf(HasSubstr("byte 60"), HasSubstr("\"TWO2\"")));

  changed = container;
  changed[50] ^= std::byte{1};
  EXPECT_THAT(error_of(changed), AllOf(HasSubstr("byte 4 "), HasSubstr("checksum")));
}

TEST(Container, NullIsNone) {
  const auto parts = read_container(nullptr, 100);
  ASSERT_FALSE(parts);
  EXPECT_EQ(parts.error().id, public_id(ErrorId::kBytecode));
}

TEST(Container, UnsignedOneIsRead) {
  auto container = two_parts();
  unsign(container);
  EXPECT_EQ(error_of(container), "");
}

}  // namespace
}  // namespace kaamos::d3d12
