// What libOpenDRIVE (github.com/pageldev/libOpenDRIVE) makes of a map: lanes, ways between them, and parking spaces.
// g++ -std=c++17 -O1 -I libOpenDRIVE/include -I pugixml/src -o libopendrive_dump tests/support/libopendrive_dump.cpp
//     libOpenDRIVE/src/*.cpp libOpenDRIVE/src/Geometries/*.cpp libOpenDRIVE/src/Geometries/Spiral/*.cpp pugixml/src/*.cpp
#include "OpenDriveMap.h"

#include <cmath>
#include <cstdio>

namespace
{
const double step_m = 0.5;
const double ends_m = 0.01; // off the ends of a road, where its slope is not defined

void print_lane(const odr::Road& road, const odr::LaneSection& section, const odr::Lane& lane)
{
    const auto middle = [&](double s) {
        const double half = lane.lane_width.evaluate(s - section.s0) / 2;
        return road.get_xyz(s, lane.outer_border.evaluate(s) - (lane.id > 0 ? half : -half), 0.0);
    };
    const double length = road.length - 2 * ends_m;
    const int    count = 1 + static_cast<int>(std::ceil(length / step_m));
    for (int i = 0; i < count; i++)
    {
        const double s = ends_m + length * i / (count - 1);
        const auto   place = middle(s), before = middle(s - ends_m / 2), after = middle(s + ends_m / 2);
        const double sign = lane.id > 0 ? -1 : 1; // cars drive on the right
        const double heading = std::atan2(sign * (after[1] - before[1]), sign * (after[0] - before[0]));
        std::printf("lane %s %d %.9f %.9f %.9f %.9f %.9f\n", road.id.c_str(), lane.id, place[0], place[1], place[2],
                    heading, lane.lane_width.evaluate(s - section.s0));
    }
}
} // namespace

int main(int count, char** words)
{
    if (count != 2)
    {
        std::fprintf(stderr, "libopendrive_dump MAP\n");
        return 2;
    }
    const odr::OpenDriveMap map(words[1]);
    for (const auto& road : map.get_roads())
    {
        for (const auto& section : road.get_lanesections())
            for (const auto& lane : section.get_lanes())
                if (lane.type == "driving")
                    print_lane(road, section, lane);
        for (const auto& thing : road.get_road_objects())
        {
            if (thing.type != "parkingSpace")
                continue;
            std::printf("space %s", thing.name.c_str());
            for (const auto& corner : road.get_road_object_mesh(thing, 0.01).vertices)
                std::printf(" %.9f %.9f %.9f", corner[0], corner[1], corner[2]);
            std::printf("\n");
        }
    }
    for (const auto& way : map.get_routing_graph().edges)
        std::printf("way %s %d %s %d\n", way.from.road_id.c_str(), way.from.lane_id, way.to.road_id.c_str(), way.to.lane_id);
}
