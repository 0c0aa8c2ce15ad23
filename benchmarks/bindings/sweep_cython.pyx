# cython: language_level=3, boundscheck=False
# By Cython, whose memory views carry type, dimensions and order.
from libc.stdint cimport int64_t, uint8_t


cdef extern from "driving.h":
    ctypedef uint8_t c_bool "bool"
    ctypedef struct DoubleCube:
        double *at
        int64_t layers, rows, columns
    ctypedef struct DoubleTable:
        double *at
        int64_t rows, columns
    ctypedef struct DoubleRow:
        double *at
        int64_t count
    ctypedef struct Scene:
        DoubleCube shapes
        DoubleTable boxes
        DoubleRow body

cdef extern from *:
    """
    double least_along(const Scene *scene, const double *poses, int64_t steps, const double *bulges, double most);
    void mark_touched(const Scene *scene, const double *pose, double margin, bool *is_touched);
    """
    double c_least_along "least_along"(const Scene *, const double *, int64_t, const double *, double)
    void c_mark_touched "mark_touched"(const Scene *, const double *, double, c_bool *)


cdef Scene packed(const double[:, :, ::1] shapes, const double[:, ::1] boxes, const double[::1] body):
    cdef Scene scene
    scene.shapes.at = <double *>&shapes[0, 0, 0]
    scene.shapes.layers, scene.shapes.rows, scene.shapes.columns = shapes.shape[0], shapes.shape[1], shapes.shape[2]
    scene.boxes.at = <double *>&boxes[0, 0]
    scene.boxes.rows, scene.boxes.columns = boxes.shape[0], boxes.shape[1]
    scene.body.at = <double *>&body[0]
    scene.body.count = body.shape[0]
    return scene


def least_along(scene, const double[:, ::1] poses not None, int64_t steps, const double[::1] bulges not None, double most):
    shapes, boxes, body = scene
    cdef Scene own = packed(shapes, boxes, body)
    return c_least_along(&own, &poses[0, 0], steps, &bulges[0], most)


def mark_touched(scene, const double[::1] pose not None, double margin, is_touched):
    if is_touched.dtype != bool:  # memory views take no array of bool
        raise TypeError(f"an array of {is_touched.dtype}, not bool")
    cdef uint8_t[::1] flags = is_touched.view("uint8")
    shapes, boxes, body = scene
    cdef Scene own = packed(shapes, boxes, body)
    c_mark_touched(&own, &pose[0], margin, <c_bool *>&flags[0])
