// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "drivers/usb/acm_layout.hpp"
#include "drivers/usb/acm_line.hpp"
#include "drivers/usb/chunk_queue.hpp"
#include "drivers/usb/usb_options.hpp"
#include "drivers/usb/usb_scanner_opener.hpp"

namespace stairway::drivers {
namespace {

using std::chrono::milliseconds;

libusb_endpoint_descriptor endpoint(std::uint8_t address, std::uint8_t type, std::uint16_t packet_bytes) {
  libusb_endpoint_descriptor out{};
  out.bEndpointAddress = address;
  out.bmAttributes = type;
  out.wMaxPacketSize = packet_bytes;
  return out;
}

// A configuration with one setting for each interface.
class Configuration {
 public:
  void add(std::uint8_t number, std::uint8_t device_class, std::vector<libusb_endpoint_descriptor> endpoints) {
    interfaces_.push_back({number, device_class, std::move(endpoints), {}});
  }

  libusb_config_descriptor get() {
    views_.clear();
    for (Interface& interface : interfaces_) {
      interface.setting = {};
      interface.setting.bInterfaceNumber = interface.number;
      interface.setting.bInterfaceClass = interface.device_class;
      interface.setting.bNumEndpoints = static_cast<std::uint8_t>(interface.endpoints.size());
      interface.setting.endpoint = interface.endpoints.data();
      views_.push_back({&interface.setting, 1});
    }
    libusb_config_descriptor configuration{};
    configuration.bNumInterfaces = static_cast<std::uint8_t>(views_.size());
    configuration.interface = views_.data();
    return configuration;
  }

 private:
  struct Interface {
    std::uint8_t number;
    std::uint8_t device_class;
    std::vector<libusb_endpoint_descriptor> endpoints;
    libusb_interface_descriptor setting;
  };
  std::vector<Interface> interfaces_;
  std::vector<libusb_interface> views_;
};

TEST(AcmLayout, is_found_by_class_and_direction_whatever_the_numbers) {
  Configuration usual;
  usual.add(0, LIBUSB_CLASS_COMM, {endpoint(0x83, LIBUSB_TRANSFER_TYPE_INTERRUPT, 8)});
  usual.add(1, LIBUSB_CLASS_DATA,
            {endpoint(0x81, LIBUSB_TRANSFER_TYPE_BULK, 64), endpoint(0x02, LIBUSB_TRANSFER_TYPE_BULK, 64)});
  const auto layout = find_acm_layout(usual.get());
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->control_interface, 0);
  EXPECT_EQ(layout->data_interface, 1);
  EXPECT_EQ(layout->endpoint_in, 0x81);
  EXPECT_EQ(layout->endpoint_out, 0x02);
  EXPECT_EQ(layout->in_packet_bytes, 64);

  Configuration swapped;
  swapped.add(4, LIBUSB_CLASS_DATA,
              {endpoint(0x05, LIBUSB_TRANSFER_TYPE_BULK, 512), endpoint(0x86, LIBUSB_TRANSFER_TYPE_BULK, 512)});
  swapped.add(7, LIBUSB_CLASS_COMM, {});
  const auto other = find_acm_layout(swapped.get());
  ASSERT_TRUE(other);
  EXPECT_EQ(other->control_interface, 7);
  EXPECT_EQ(other->data_interface, 4);
  EXPECT_EQ(other->endpoint_in, 0x86);
  EXPECT_EQ(other->endpoint_out, 0x05);
  EXPECT_EQ(other->in_packet_bytes, 512);
}

TEST(AcmLayout, is_missing_where_a_direction_or_the_class_is) {
  Configuration nothing;
  EXPECT_FALSE(find_acm_layout(nothing.get()));
  Configuration one_way;
  one_way.add(1, LIBUSB_CLASS_DATA, {endpoint(0x81, LIBUSB_TRANSFER_TYPE_BULK, 64)});
  EXPECT_FALSE(find_acm_layout(one_way.get()));
  Configuration interrupts;
  interrupts.add(1, LIBUSB_CLASS_DATA,
                 {endpoint(0x81, LIBUSB_TRANSFER_TYPE_INTERRUPT, 64), endpoint(2, LIBUSB_TRANSFER_TYPE_INTERRUPT, 64)});
  EXPECT_FALSE(find_acm_layout(interrupts.get()));
  Configuration storage;
  storage.add(0, LIBUSB_CLASS_MASS_STORAGE,
              {endpoint(0x81, LIBUSB_TRANSFER_TYPE_BULK, 64), endpoint(0x02, LIBUSB_TRANSFER_TYPE_BULK, 64)});
  EXPECT_FALSE(find_acm_layout(storage.get()));
}

TEST(ChunkQueue, gives_chunks_in_order_and_then_waits) {
  ChunkQueue queue(4);
  queue.push({1, "a"});
  queue.push({2, "b"});
  EXPECT_EQ(queue.pop(milliseconds(0)).value()->bytes, "a");
  EXPECT_EQ(queue.pop(milliseconds(0)).value()->arrival_ns, 2);
  EXPECT_EQ(queue.pop(milliseconds(1)).value(), std::nullopt);
}

TEST(ChunkQueue, drops_the_oldest_and_tells_how_much) {
  ChunkQueue queue(2);
  for (const char* bytes : {"first", "second", "third", "fourth"}) queue.push({0, bytes});
  const auto chunk = queue.pop(milliseconds(0)).value();
  EXPECT_EQ(chunk->bytes, "third");
  EXPECT_EQ(chunk->lost_bytes, 11U);
  EXPECT_EQ(queue.pop(milliseconds(0)).value()->lost_bytes, 0U);
}

TEST(ChunkQueue, gives_what_it_holds_after_it_was_closed) {
  ChunkQueue queue(2);
  queue.push({0, "last"});
  queue.close();
  EXPECT_EQ(queue.pop(milliseconds(0)).value()->bytes, "last");
  EXPECT_EQ(queue.pop(milliseconds(1000)).error(), PortError::Closed);
}

TEST(ChunkQueue, wakes_a_reader) {
  ChunkQueue queue(2);
  std::thread writer([&] { queue.push({0, "x"}); });
  EXPECT_EQ(queue.pop(std::chrono::minutes(1)).value()->bytes, "x");
  writer.join();
  std::thread closer([&] { queue.close(); });
  EXPECT_FALSE(queue.pop(std::chrono::minutes(1)));
  closer.join();
}

TEST(UsbOptions, take_a_path_as_the_kernel_writes_it) {
  for (const char* port : {"", "1-2", "1-2.3", "2-1.4.3.1", "12-10"}) EXPECT_EQ(UsbOptions{port}.problem(), "") << port;
  for (const char* port : {"1", "1-", "-2", "1-2.", "1-2..3", "1-2:1.0", "usb1", "/dev/ttyACM0", "1-2-3", "1-0002"}) {
    EXPECT_NE(UsbOptions{port}.problem().find("1-2.3"), std::string::npos) << port;
  }
}

// Passes with and without USB on this machine, and with and without a scanner: at a port that no machine has, there is
// none.
TEST(UsbScannerOpener, tells_why_there_is_no_scanner_and_tries_again) {
  UsbScannerOpener opener({"255-7.7.7.7.7.7"}, "");
  EXPECT_FALSE(opener.wait(milliseconds(1)));
  for (int attempt = 0; attempt < 3; ++attempt) {
    const auto port = opener.open();
    ASSERT_FALSE(port);
    EXPECT_NE(port.error().find("USB"), std::string::npos) << port.error();
    EXPECT_FALSE(opener.wait(milliseconds(1)));
  }
}

TEST(AcmLine, coding_is_the_rate_little_endian_and_8n1) {
  using Coding = std::array<unsigned char, 7>;
  EXPECT_EQ(line_coding(115200), (Coding{0x00, 0xC2, 0x01, 0x00, 0, 0, 8}));
  EXPECT_EQ(line_coding(9600), (Coding{0x80, 0x25, 0x00, 0x00, 0, 0, 8}));
  EXPECT_EQ(line_coding(0x12345678), (Coding{0x78, 0x56, 0x34, 0x12, 0, 0, 8}));
}

TEST(AcmLine, only_a_refusal_is_no_problem) {
  for (const int fine : {7, 0, static_cast<int>(LIBUSB_ERROR_PIPE)}) EXPECT_EQ(line_setting_problem(fine), "");
  for (const int bad : {LIBUSB_ERROR_TIMEOUT, LIBUSB_ERROR_NO_DEVICE, LIBUSB_ERROR_IO})
    EXPECT_NE(line_setting_problem(bad).find(libusb_strerror(bad)), std::string::npos);
}

}  // namespace
}  // namespace stairway::drivers
