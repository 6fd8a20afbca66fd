// What is used of LAPACK, which brings no header. Column by column, integers of 32 bits; triangle
// "L": the lower one.
#pragma once

#include <cstddef>

extern "C" {
void dpotri_(const char* triangle, const int* n, double* matrix, const int* stride, int* info,
             std::size_t length_of_triangle);
void dgesv_(const int* n, const int* columns, double* matrix, const int* stride, int* pivots,
            double* right, const int* right_stride, int* info);
void dsgesv_(const int* n, const int* columns, double* matrix, const int* stride, int* pivots,
             const double* b, const int* b_stride, double* x, const int* x_stride, double* residual,
             float* rounded, int* refinements, int* info);
}
