// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "config/section.hpp"

namespace stairway::config {
namespace {

// A choice names every enumerator in order; the last one tells when there are more.
static_assert(static_cast<int>(detect::Strategy::Joint) == 3);
static_assert(static_cast<int>(detect::SegmentationMethod::VoxelSac) == 2);

}  // namespace

void add_detector_settings(std::vector<Entry>& table, detect::DetectorOptions& detector) {
  Section(table, "detector")
      .real("voxel", detector.voxel_m, kMillimetre, {1, 200}, "edge of the thinning cells")
      .whole("threads", detector.threads, 1, 64, "that look for planes at once; the answer is the same for any number");

  detect::SegmentationOptions& segmentation = detector.segmentation;
  Section(table, "detector.segmentation")
      .choice("method", segmentation.method, {"region-growing", "split-and-merge", "voxel-sac"},
              "how planar regions are found")
      .real("min_grazing", segmentation.min_grazing_rad, kDegree, {0, 44},
            "surfaces seen flatter than this are ghosts of two others; 0 keeps them");

  Section(table, "detector.level")
      .on_off("by_scene", detector.level.enabled,
              "turn the cloud so that floors, treads and walls are level and upright")
      .real("max_tilt", detector.level.max_tilt_rad, kDegree, {0.1, 22}, "of the cloud against level")
      .real("max_sigma", detector.level.max_sigma_rad, kDegree, {0.001, 10}, "what is less certain is not used");

  Section(table, "detector.normals")
      .real("radius", segmentation.normals.radius_m, kMillimetre, {5, 500}, "neighbours within it make a normal")
      .whole("min_neighbours", segmentation.normals.min_neighbours, 3, 1000,
             "where the radius holds fewer points, it is doubled, up to three times");

  Section(table, "detector.region_growing")
      .whole("num_neighbours", segmentation.region_growing.num_neighbours, 3, 200, "neighbours a region may grow over")
      .real("max_normal_angle", segmentation.region_growing.max_normal_angle_rad, kDegree, {1, 89},
            "normal of a point against the region's")
      .real("max_plane_distance", segmentation.region_growing.max_plane_distance_m, kMillimetre, {1, 500},
            "point to the plane of the region; about three times the range noise")
      .whole("min_points", segmentation.region_growing.min_points, 3, 1000000,
             "a region must have more points than this");

  detect::PatchOptions& patches = segmentation.patches;
  Section(table, "detector.patches")
      .on_off("enabled", patches.enabled, "grow regions over cells that are certainly planar, faster, not over points")
      .real("edge", patches.edge_m, kMillimetre, {20, 2000}, "of the cells")
      .whole("min_points", patches.min_points, 3, 1000000, "a patch has more points than this")
      .real("max_thickness", patches.max_thickness_m, kMillimetre, {1, 500},
            "standard deviation of its points from their plane; half as much again as the range noise");

  detect::SplitAndMergeOptions& split_and_merge = segmentation.split_and_merge;
  Section(table, "detector.split_and_merge")
      .real("max_leaf", split_and_merge.max_leaf_m, kMillimetre, {10, 10000}, "edge of the largest cells")
      .real("min_leaf", split_and_merge.min_leaf_m, kMillimetre, {10, 1000}, "edge of the smallest cells")
      .whole("min_leaf_points", split_and_merge.min_leaf_points, 3, 10000, "fewer points in a cell tell no plane")
      .real("max_leaf_distance", split_and_merge.max_leaf_distance_m, kMillimetre, {1, 500},
            "every point of a cell to the cell's plane; about four times the range noise")
      .real("max_normal_angle", split_and_merge.max_normal_angle_rad, kDegree, {1, 89},
            "normal of a cell against the region's")
      .real("max_plane_distance", split_and_merge.max_plane_distance_m, kMillimetre, {1, 500},
            "middle of a cell to the plane of the region")
      .whole("min_points", split_and_merge.min_points, 3, 1000000, "a region must have more points than this");

  detect::VoxelSacOptions& voxel_sac = segmentation.voxel_sac;
  Section(table, "detector.voxel_sac")
      .real("max_leaf", voxel_sac.max_leaf_m, kMillimetre, {10, 10000}, "edge of the largest cells")
      .real("min_leaf", voxel_sac.min_leaf_m, kMillimetre, {10, 1000}, "edge of the smallest cells")
      .whole("iterations", voxel_sac.iterations, 1, 100000, "planes through three points that are tried in a cell")
      .real("min_inlier_share", voxel_sac.min_inlier_share, kPlain, {0.01, 1},
            "of the points of a cell that must lie in its plane")
      .real("max_plane_distance", voxel_sac.max_plane_distance_m, kMillimetre, {1, 500},
            "point to the plane; about three times the range noise")
      .real("max_normal_angle", voxel_sac.max_normal_angle_rad, kDegree, {1, 89},
            "normal of a point against the plane's")
      .whole("min_cell_points", voxel_sac.min_cell_points, 1, 1000,
             "a region spreads on from a cell that gave it so many points")
      .whole("min_points", voxel_sac.min_points, 3, 1000000, "a region must have more points than this");

  Section(table, "detector.plane_finder")
      .real("max_tilt", detector.plane_finder.max_tilt_rad, kDegree, {1, 45},
            "normal against the horizontal (riser) or the vertical (tread)")
      .real("max_riser_height", detector.plane_finder.max_riser_height_m, kMillimetre, {20, 1000},
            "vertical extent of a riser")
      .real("max_tread_depth", detector.plane_finder.max_tread_depth_m, kMillimetre, {20, 2000},
            "horizontal extent of a tread in the direction of ascent")
      .real("min_width", detector.plane_finder.min_width_m, kMillimetre, {10, 2000},
            "risers and treads that show less of their width are left out")
      .on_off("find_edges", detector.plane_finder.find_edges,
              "also look for bars along the nosings of open treads, and for strips of treads below the floor")
      .real("max_edge_thickness", detector.plane_finder.max_edge_thickness_m, kMillimetre, {1, 1000},
            "extent of a tread's edge across its length")
      .real("min_edge_width", detector.plane_finder.min_edge_width_m, kMillimetre, {10, 2000},
            "extent of a tread's edge along its length")
      .real("max_edge_tilt", detector.plane_finder.max_edge_tilt_rad, kDegree, {0, 45},
            "of a tread's edge against the horizontal");

  detect::FragmentMergingOptions& merging = detector.fragment_merging;
  Section(table, "detector.fragment_merging")
      .on_off("enabled", merging.enabled, "join regions that are pieces of one riser or tread")
      .real("max_offset", merging.max_offset_m, kMillimetre, {0, 200}, "between two pieces, across their plane")
      .real("max_gap", merging.max_gap_m, kMillimetre, {0, 2000}, "between two pieces, in their plane")
      .real("max_riser_angle", merging.max_riser_angle_rad, kDegree, {1, 89},
            "between the normals of two riser pieces");

  detect::CompetitionOptions& competition = detector.competition;
  Section(table, "detector.competition")
      .choice("strategy", competition.strategy, {"greedy", "thorough", "optimizing", "joint"},
              "how candidates that claim the same parts compete");

  detect::StepLimits& steps = competition.initialisation.limits;
  Section(table, "detector.steps")
      .real("min_height", steps.min_height_m, kMillimetre, {10, 1000}, "lowest step")
      .real("max_height", steps.max_height_m, kMillimetre, {10, 1000}, "highest step")
      .real("min_depth", steps.min_depth_m, kMillimetre, {10, 2000}, "shallowest step")
      .real("max_depth", steps.max_depth_m, kMillimetre, {10, 2000}, "deepest step")
      .real("min_slope", steps.min_slope_rad, kDegree, {0, 89}, "flattest pair of steps")
      .real("max_slope", steps.max_slope_rad, kDegree, {1, 89}, "steepest pair of steps")
      .real("min_turn", steps.min_turn_rad, kDegree, {1, 89}, "least turn from step to step of a spiral")
      .real("max_turn", steps.max_turn_rad, kDegree, {1, 89}, "largest turn from step to step of a spiral");

  detect::InitialisationOptions& initialisation = competition.initialisation;
  Section(table, "detector.initialisation")
      .real("max_pair_distance", initialisation.max_pair_distance_m, kMillimetre, {10, 10000},
            "between two parts of neighbouring steps, horizontally")
      .real("max_riser_angle", initialisation.max_riser_angle_rad, kDegree, {1, 89},
            "between two risers of neighbouring steps")
      .real("min_side_overlap", initialisation.min_side_overlap_m, kMillimetre, {0, 2000},
            "of two parts, across the stairway")
      .on_off("spirals", initialisation.spirals, "also start spirals");

  detect::ExtensionOptions& extension = competition.extension;
  Section(table, "detector.extension")
      .real("search_radius", extension.search_radius_m, kMillimetre, {10, 10000},
            "around the place where the next step is expected")
      .whole("max_empty_steps", extension.max_empty_steps, 0, 20,
             "a stairway ends after this many steps without a part")
      .whole("max_steps", extension.max_steps, 1, 10000, "no stairway is longer")
      .real("max_depth_deviation", extension.max_depth_deviation_m, kMillimetre, {1, 500},
            "of a part from the model, in the direction of ascent")
      .real("max_height_deviation", extension.max_height_deviation_m, kMillimetre, {1, 500},
            "of a part from the model, vertically")
      .real("max_direction", extension.max_direction_rad, kDegree, {1, 89}, "of a part from the direction of ascent")
      .real("min_side_overlap", extension.min_side_overlap_m, kMillimetre, {0, 2000},
            "of a part with the stairway found so far");

  detect::ConfirmationOptions& confirmation = competition.confirmation;
  Section(table, "detector.confirmation")
      .real("min_slope", confirmation.min_slope_rad, kDegree, {0, 89}, "flattest stairway")
      .real("max_slope", confirmation.max_slope_rad, kDegree, {1, 89}, "steepest stairway")
      .whole("min_steps", confirmation.min_steps, 2, 1000, "steps that must have been seen");

  detect::JointFitOptions& joint_fit = detector.joint_fit;
  Section(table, "detector.joint_fit")
      .whole("passes", joint_fit.passes, 1, 100, "of measuring all steps and fitting the model to them")
      .whole("max_unseen_steps", joint_fit.max_unseen_steps, 0, 100,
             "a stairway ends after this many steps in a row without points")
      .real("max_sigma", joint_fit.max_sigma_m, kMillimetre, {0.1, 1000},
            "of step height and depth; what is less certain is no stairway to climb")
      .real("min_seen_share", joint_fit.min_seen_share, kPlain, {0, 1},
            "of the steps from the first to the last seen, so many must show points")
      .real("range_sigma", joint_fit.measurement.range_sigma_m, kMillimetre, {0.1, 500}, "noise of one point")
      .real("spot", joint_fit.measurement.spot_rad, kMilliradian, {0, 100},
            "full angle of the sensor's beam, whose points at edges are mixed")
      .real("search", joint_fit.measurement.search_m, kMillimetre, {1, 500},
            "fronts and surfaces are looked for this far from the model")
      .whole("min_points", joint_fit.measurement.min_points, 3, 100000, "of a front or a surface")
      .real("min_coverage", joint_fit.measurement.min_coverage, kPlain, {0, 1},
            "share of the side that a front or surface must cover")
      .real("min_contrast", joint_fit.measurement.min_contrast, kPlain, {0, 1000},
            "density of points on a front or surface against that around it")
      .real("pulse_separation", joint_fit.beams.pulse_separation_m, kMillimetre, {1, 100000},
            "surfaces nearer to each other in range give one echo between them")
      .whole("edge_beams", joint_fit.beams.edge_beams, 1, 1000000, "fitted at most, of those next to an edge")
      .whole("plane_beams", joint_fit.beams.plane_beams, 1, 1000000, "fitted at most, of those on one face")
      .real("max_misfit", joint_fit.beams.max_misfit, kPlain, {0.1, 100},
            "in sigmas; beams that differ more do not see what is fitted to them")
      .real("min_explained", joint_fit.beams.min_explained, kPlain, {0, 1},
            "share of the beams that must measure what the flight says");

  detect::RailingOptions& railing = detector.railing;
  Section(table, "detector.railing")
      .on_off("enabled", railing.enabled, "look for railings; they decide on which side the anchor is")
      .real("max_side_distance", railing.max_side_distance_m, kMillimetre, {1, 1000},
            "of handrail and balusters from the end of the steps")
      .real("min_handrail_height", railing.min_handrail_height_m, kMillimetre, {100, 3000},
            "of a handrail above the line of nosings")
      .real("max_handrail_height", railing.max_handrail_height_m, kMillimetre, {100, 3000}, "likewise")
      .real("max_handrail_angle", railing.max_handrail_angle_rad, kDegree, {1, 45},
            "of a handrail against the line of nosings")
      .real("max_baluster_angle", railing.max_baluster_angle_rad, kDegree, {1, 45},
            "of a baluster against the vertical")
      .real("max_thickness", railing.max_thickness_m, kMillimetre, {10, 1000},
            "of a handrail or a baluster; what is thicker is a wall or a person")
      .real("min_handrail_length", railing.min_handrail_length_m, kMillimetre, {100, 10000},
            "that must be seen of a handrail")
      .whole("min_balusters", railing.min_balusters, 2, 100, "so many in a row are a railing without a handrail");

  Section(table, "detector.localisation")
      .whole("max_hidden_steps", detector.localisation.max_hidden_steps, 0, 100,
             "steps that may be added between the lowest seen one and the floor");
}

}  // namespace stairway::config
