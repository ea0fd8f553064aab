// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstddef>
#include <utility>

#include "config/settings_table.hpp"

namespace stairway::config {
namespace {

/// Stands for a member of any type.
struct Anything {
  template <class T>
  operator T() const;  // NOLINT: never called
};

template <class T, std::size_t... I>
constexpr bool is_made_of(std::index_sequence<I...>) {
  return requires { T{(static_cast<void>(I), Anything{})...}; };
}

/// The number of members of a struct without constructors.
template <class T, std::size_t Most = 30>
constexpr std::size_t count_members() {
  if constexpr (Most == 0 || is_made_of<T>(std::make_index_sequence<Most>{})) {
    return Most;
  } else {
    return count_members<T, Most - 1>();
  }
}

std::size_t keys_of(const std::string& section) {
  Settings settings;
  std::size_t keys = 0;
  for (const Entry& entry : settings_table(settings)) {
    keys += entry.key.rfind('.') == section.size() && entry.key.starts_with(section + ".") ? 1 : 0;
  }
  return keys;
}

TEST(Options, every_member_has_a_key) {
  using namespace detect;
  struct Case {
    const char* section;
    std::size_t members;
    std::size_t nested;  ///< members that are Options with a section or keys of their own
  };
  const Case cases[] = {
      {"log", count_members<LogOptions>(), 0},
      {"lcm", count_members<ipc::BusOptions>(), 0},
      {"simulate", count_members<SimulationOptions>(), 0},
      {"disk", count_members<drivers::DiskOptions>(), 0},
      {"record", count_members<ipc::RecordOptions>(), 0},
      {"replay", count_members<ReplayOptions>(), 0},
      {"preview", count_members<PreviewOptions>(), 0},
      {"command", count_members<CommandOptions>(), 0},
      {"cloud", count_members<ipc::CloudOptions>(), 0},
      {"source", count_members<SourceOptions>(), 0},
      {"mount", count_members<scan::MountOptions>(), 0},
      {"sweep", count_members<scan::SweepOptions>() + count_members<scan::AngleTrackOptions>(), 1},
      {"detector", count_members<DetectorOptions>(), 8},
      {"detector.segmentation", count_members<SegmentationOptions>(), 5},
      {"detector.level", count_members<SceneLevelOptions>(), 0},
      {"detector.normals", count_members<NormalOptions>(), 0},
      {"detector.region_growing", count_members<RegionGrowingOptions>(), 0},
      {"detector.patches", count_members<PatchOptions>(), 0},
      {"detector.split_and_merge", count_members<SplitAndMergeOptions>(), 0},
      {"detector.voxel_sac", count_members<VoxelSacOptions>(), 0},
      {"detector.plane_finder", count_members<PlaneFinderOptions>(), 0},
      {"detector.fragment_merging", count_members<FragmentMergingOptions>(), 0},
      {"detector.competition", count_members<CompetitionOptions>(), 3},
      {"detector.steps", count_members<StepLimits>(), 0},
      {"detector.initialisation", count_members<InitialisationOptions>(), 1},
      {"detector.extension", count_members<ExtensionOptions>(), 0},
      {"detector.confirmation", count_members<ConfirmationOptions>(), 0},
      {"detector.joint_fit",
       count_members<JointFitOptions>() + count_members<StepMeasurementOptions>() + count_members<BeamFitOptions>(), 2},
      {"detector.railing", count_members<RailingOptions>(), 0},
      {"detector.localisation", count_members<LocalisationOptions>(), 0},
  };
  for (const Case& entry : cases) EXPECT_EQ(keys_of(entry.section), entry.members - entry.nested) << entry.section;
  const std::size_t lidar = count_members<drivers::ScipOptions>() + count_members<drivers::ClockOptions>() +
                            count_members<drivers::UsbOptions>() + count_members<drivers::SyncInputOptions>() - 1;
  EXPECT_EQ(keys_of("lidar") + keys_of("lidar.timing"), lidar);
  EXPECT_EQ(keys_of("motor") + keys_of("motor.timing"), count_members<drivers::MotorOptions>());
  EXPECT_EQ(keys_of("encoder"), count_members<drivers::EncoderOptions>());
}

}  // namespace
}  // namespace stairway::config
