// By nanobind, whose arrays carry type, dimensions and order; `noconvert` keeps it from copying those that differ.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

extern "C" {
#include "driving.h"
double least_along(const Scene *scene, const double *poses, int64_t steps, const double *bulges, double most);
void mark_touched(const Scene *scene, const double *pose, double margin, bool *is_touched);
}

namespace nb = nanobind;
using namespace nb::literals;

template <typename T, size_t dimensions> using Array = nb::ndarray<T, nb::ndim<dimensions>, nb::c_contig, nb::device::cpu>;
using Cube = Array<const double, 3>;
using Table = Array<const double, 2>;
using Row = Array<const double, 1>;
using Flags = Array<bool, 1>;

static Scene packed(Cube &shapes, Table &boxes, Row &body)
{
    return {{const_cast<double *>(shapes.data()), (int64_t)shapes.shape(0), (int64_t)shapes.shape(1),
             (int64_t)shapes.shape(2)},
            {const_cast<double *>(boxes.data()), (int64_t)boxes.shape(0), (int64_t)boxes.shape(1)},
            {const_cast<double *>(body.data()), (int64_t)body.shape(0)}};
}

NB_MODULE(sweep_nanobind, module)
{
    module.def("least_along",
               [](nb::tuple scene, Table poses, int64_t steps, Row bulges, double most) {
                   if (scene.size() != 3)
                       throw nb::type_error("a scene has three fields");
                   auto shapes = nb::cast<Cube>(scene[0], false);
                   auto boxes = nb::cast<Table>(scene[1], false);
                   auto body = nb::cast<Row>(scene[2], false);
                   Scene own = packed(shapes, boxes, body);
                   return least_along(&own, poses.data(), steps, bulges.data(), most);
               },
               "scene"_a, "poses"_a.noconvert(), "steps"_a, "bulges"_a.noconvert(), "most"_a);
    module.def("mark_touched",
               [](nb::tuple scene, Row pose, double margin, Flags is_touched) {
                   if (scene.size() != 3)
                       throw nb::type_error("a scene has three fields");
                   auto shapes = nb::cast<Cube>(scene[0], false);
                   auto boxes = nb::cast<Table>(scene[1], false);
                   auto body = nb::cast<Row>(scene[2], false);
                   Scene own = packed(shapes, boxes, body);
                   mark_touched(&own, pose.data(), margin, is_touched.data());
               },
               "scene"_a, "pose"_a.noconvert(), "margin"_a, "is_touched"_a.noconvert());
}
