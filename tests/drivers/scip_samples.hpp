// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

// Replies of a UTM-30LX with known values, for tests.
namespace stairway::drivers::samples {

inline const std::string kVersion =
    "VV\n00P\nVEND:Hokuyo Automatic Co.,Ltd.;[\nPROD:SOKUIKI Sensor TOP-URG UTM-30LX;P\nFIRM:P.1.05(17/Apr./2009);M\n"
    "PROT:SCIP 2.0;N\nSERI:00903971;:\n\n";

inline const std::string kParameters =
    "PP\n00P\nMODL:UTM-30LX(Hokuyo Automatic Co.,Ltd.);U\nDMIN:23;7\nDMAX:60000;J\nARES:1440;^\nAMIN:0;?\nAMAX:1080;Z\n"
    "AFRT:540;0\nSCAN:2400;U\n\n";

inline const std::string kState =
    "II\n00P\nMODL:UTM-30LX(Hokuyo Automatic Co.,Ltd.);U\nLASR:ON;9\n"
    "SCSP:Initial(2400[rpm])<-Default setting by user;1\nMESM:CLASSIC;^\nSBPS:USB Full Speed;P\nTIME:4991D0;d\n"
    "STAT:Sensor works well.;8\n\n";

inline const std::string kMd =
    "MD0528055101000\n99b\nBI9YM\n"
    "0?X0?Y0?[0?^0?b0?g0?m0@40@<0@E0@O0@Z0@f0A30AA0AP1>81>90010020030I\n0G7D`>YPi\n\n";

inline const std::string kMe =
    "ME0532054701100\n99b\nooojg\n"
    "0?X0O@0?_0OK0?f0OV0?m0Oa0@40Ol0010000@B0PB0@I0PM0@P0PX00401h0@^0Q\nPn0@e0Q90@l0QD0A30QO0A:0QZ0AA0Qe0\n\n";

}  // namespace stairway::drivers::samples
