/* Elementary functions that give the same bits on every machine. */
#ifndef GARAGE2USD_ELEMENTARY_H
#define GARAGE2USD_ELEMENTARY_H

#include <math.h>

#include "arrays.h"

double same_sin(double x);
double same_cos(double x);
void same_sin_cos(double x, double *sine, double *cosine);
double same_atan2(double y, double x);
double same_asin(double x);
double same_acos(double x);
double same_exp(double x);
double same_log(double x);
/* A positive number to some power, as exp(exponent * log(base)). */
double same_pow(double base, double exponent);

/* Length of the hypotenuse, for sides whose squares neither overflow nor vanish. */
static inline double same_hypot(double x, double y) { return sqrt(x * x + y * y); }

#endif
