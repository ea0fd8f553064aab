// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scip_codec.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stairway::drivers {
namespace {

struct NumberVector {
  std::uint32_t value;
  std::string text;
};

const std::vector<NumberVector> kNumbers = {
    {1234, "CB"},   {4095, "oo"},    {5432, "1Dh"},      {16000000, "m2@0"}, {0, "0000"},
    {1, "001"},     {1, "0001"},     {23, "00G"},        {30000, "7D`"},     {60000, ">YP"},
    {65533, "?om"}, {262143, "ooo"}, {16777215, "oooo"}, {4821609, "BI9Y"},  {1000, "00?X"},
};

TEST(ScipNumber, codes_known_values_both_ways) {
  for (const auto& [value, text] : kNumbers) {
    SCOPED_TRACE(text);
    EXPECT_EQ(encode_number(value, static_cast<int>(text.size())), text);
    EXPECT_EQ(decode_number(text), value);
  }
}

TEST(ScipNumber, survives_the_round_trip_for_every_two_and_three_character_value) {
  for (std::uint32_t value = 0; value < (1U << 12); ++value) ASSERT_EQ(decode_number(encode_number(value, 2)), value);
  for (std::uint32_t value = 0; value < (1U << 18); ++value) ASSERT_EQ(decode_number(encode_number(value, 3)), value);
}

TEST(ScipNumber, refuses_what_is_no_number) {
  EXPECT_EQ(decode_number("").error(), ScipError::Truncated);
  EXPECT_EQ(decode_number("0/0").error(), ScipError::BadCharacter);
  EXPECT_EQ(decode_number("0p0").error(), ScipError::BadCharacter);
  EXPECT_EQ(decode_number("0\n0").error(), ScipError::BadCharacter);
  EXPECT_EQ(decode_number("0\xC0\x30").error(), ScipError::BadCharacter);
  EXPECT_EQ(decode_number("000000").error(), ScipError::BadForm);
}

TEST(ScipLine, sums_every_status) {
  for (const std::string line : {"00P", "99b", "01Q", "02R", "03S", "04T", "05U", "06V", "07W", "10Q", "0Aa", "0Bb",
                                 "0Cc", "0Dd", "0Ee", "0Ff", "0Gg", "0Hh", "0Ii", "0Ll", "21S", "50U", "98a"}) {
    SCOPED_TRACE(line);
    std::string encoded;
    append_line(encoded, line.substr(0, 2));
    EXPECT_EQ(encoded, line + "\n");
    EXPECT_EQ(checked_body(line), line.substr(0, 2));
  }
}

TEST(ScipLine, refuses_a_wrong_sum_and_a_line_that_is_too_short) {
  EXPECT_EQ(checked_body("00Q").error(), ScipError::BadSum);
  EXPECT_EQ(checked_body("P").error(), ScipError::Truncated);
  EXPECT_EQ(checked_body("").error(), ScipError::Truncated);
}

TEST(ScipDataBlock, is_cut_after_64_characters) {
  std::string out;
  append_data_block(out, std::string(130, '0'));
  std::string_view rest = out;
  EXPECT_EQ(take_line(rest).size(), 65U);
  EXPECT_EQ(take_line(rest).size(), 65U);
  EXPECT_EQ(take_line(rest).size(), 3U);
  EXPECT_TRUE(rest.empty());
}

TEST(ScipKeyValue, reads_recorded_lines_and_writes_them_again) {
  struct Line {
    std::string line, key, value;
  };
  for (const auto& [line, key, value] :
       std::vector<Line>{{"DMIN:23;7", "DMIN", "23"},
                         {"SERI:00903971;:", "SERI", "00903971"},
                         {"PROT:SCIP 2.0;N", "PROT", "SCIP 2.0"},
                         {"TIME:4991D0;d", "TIME", "4991D0"},
                         {"STAT:Sensor works well.;8", "STAT", "Sensor works well."}}) {
    SCOPED_TRACE(line);
    const auto entry = parse_key_value(line);
    ASSERT_TRUE(entry);
    EXPECT_EQ(entry->key, key);
    EXPECT_EQ(entry->value, value);
    std::string encoded;
    append_key_value(encoded, key, value);
    EXPECT_EQ(encoded, line + "\n");
  }
}

TEST(ScipKeyValue, accepts_the_three_sums_that_firmwares_use) {
  const std::string text = "SCSP:Initial(2400[rpm])<-Default setting by user";
  const std::string before_arrow = "SCSP:Initial(2400[rpm])";
  for (const std::string& summed : {text, text + ";", before_arrow}) {
    SCOPED_TRACE(summed);
    const std::string line = text + ";" + line_sum(summed);
    const auto entry = parse_key_value(line);
    ASSERT_TRUE(entry);
    EXPECT_EQ(entry->value, "Initial(2400[rpm])<-Default setting by user");
  }
  EXPECT_EQ(parse_key_value(text + ";" + static_cast<char>(line_sum(text) + 1)).error(), ScipError::BadSum);
}

TEST(ScipKeyValue, splits_at_the_last_semicolon) {
  std::string line;
  append_key_value(line, "TIME", "j;o[");
  line.pop_back();
  const auto entry = parse_key_value(line);
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->value, "j;o[");
  EXPECT_EQ(line, "TIME:j;o[;H");
}

TEST(ScipKeyValue, refuses_lines_of_another_form) {
  for (const std::string line : {"", "A;B", "DMIN:237", "DMIN23;7", ":23;7"}) {
    SCOPED_TRACE(line);
    EXPECT_FALSE(parse_key_value(line));
  }
}

}  // namespace
}  // namespace stairway::drivers
