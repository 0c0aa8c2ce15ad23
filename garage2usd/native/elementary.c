/* Elementary functions that give the same bits on every machine.
 *
 * C libraries round sin, log and the like differently in the last bit, even one library on two processors. These functions
 * use only operations that IEEE 754 defines to the last bit: sums, products, quotients, square roots, and integers. They
 * are compiled with -ffp-contract=off, so that no product and sum are fused.
 *
 * Source: methods and coefficients are those of FDLIBM 5.3 (e_rem_pio2.c, k_sin.c, k_cos.c, s_atan.c, e_atan2.c, e_asin.c,
 * e_acos.c, e_exp.c, e_log.c), written anew. FDLIBM is Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved.
 * Developed at SunPro, a Sun Microsystems, Inc. business. Permission to use, copy, modify, and distribute this software is
 * freely granted, provided that this notice is preserved. */
#include "elementary.h"

#include <string.h>

#define HALF_PI_HIGH 1.57079632679489655800e+00
#define HALF_PI_LOW 6.12323399573676603587e-17
#define PI_HIGH 3.14159265358979311600e+00
#define PI_LOW 1.22464679914735320717e-16
#define LN2_HIGH 6.93147180369123816490e-01
#define LN2_LOW 1.90821492927058770002e-10
/* Angles beyond 2^20 quarter turns have too few bits for the reduction; they give NAN. */
#define MOST_QUARTERS 1048576.0

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static double from_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The upper half of a number's bits, whose square is exact. */
static double upper_half(double x) { return from_bits(bits_of(x) & UINT64_C(0xFFFFFFFF00000000)); }

static int64_t exponent_of(double x) { return (int64_t)(bits_of(x) >> 52 & 0x7FF); }

/* 2 to an integer power, for normal numbers. */
static double power_of_2(int64_t exponent) { return from_bits((uint64_t)(exponent + 1023) << 52); }

/* An angle within an eighth of a turn, in two parts, and the number of quarter turns that were taken off. */
typedef struct { double high, low; int64_t quarters; } Reduced;

/* Subtract quarter turns (W. J. Cody, W. Waite, 1980): pi / 2 in up to three parts, each product exact. */
static Reduced reduced(double x)
{
    static const double part[3] = {1.57079632673412561417e+00, 6.07710050630396597660e-11, 2.02226624871116645580e-21};
    static const double rest[3] = {6.07710050650619224932e-11, 2.02226624879595063154e-21, 8.47842766036889956997e-32};
    if (fabs(x) <= 0.78539816339744830962)
        return (Reduced){x, 0.0, 0};
    double count = floor(fabs(x) * 6.36619772367581382433e-01 + 0.5);
    double left = fabs(x) - count * part[0], tail = count * rest[0], high = left - tail;
    /* bits that cancelled are fetched from the next part of pi / 2 */
    static const int64_t cancelled[2] = {16, 49};
    for (int next = 1; next < 3 && exponent_of(x) - exponent_of(high) > cancelled[next - 1]; next++) {
        double before = left, taken = count * part[next];
        left = before - taken;
        tail = count * rest[next] - ((before - left) - taken);
        high = left - tail;
    }
    double low = (left - high) - tail;
    return x < 0 ? (Reduced){-high, -low, -(int64_t)count} : (Reduced){high, low, (int64_t)count};
}

/* Sine of an angle within an eighth of a turn, given in two parts. */
static double small_sin(double x, double low)
{
    double z = x * x, cube = z * x;
    double r = 8.33333333332248946124e-03 +
               z * (-1.98412698298579493134e-04 +
                    z * (2.75573137070700676789e-06 +
                         z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
    return x - ((z * (0.5 * low - cube * r) - low) - cube * -1.66666666666666324348e-01);
}

/* Cosine of an angle within an eighth of a turn, given in two parts. */
static double small_cos(double x, double low)
{
    double z = x * x;
    double r = z * (4.16666666666666019037e-02 +
                    z * (-1.38888888888741095749e-03 +
                         z * (2.48015872894767294178e-05 +
                              z * (-2.75573143513906633035e-07 +
                                   z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
    double half = 0.5 * z, most = 1.0 - half;
    return most + (((1.0 - most) - half) + (z * r - x * low));
}

void same_sin_cos(double x, double *sine, double *cosine)
{
    if (!(fabs(x) < MOST_QUARTERS * HALF_PI_HIGH)) {
        *sine = *cosine = NAN;
        return;
    }
    Reduced angle = reduced(x);
    double s = small_sin(angle.high, angle.low), c = small_cos(angle.high, angle.low);
    bool is_swapped = angle.quarters & 1;
    *sine = is_swapped ? c : s;
    *cosine = is_swapped ? s : c;
    if (angle.quarters & 2)
        *sine = -*sine;
    if ((angle.quarters + 1) & 2)
        *cosine = -*cosine;
}

double same_sin(double x)
{
    double sine, cosine;
    same_sin_cos(x, &sine, &cosine);
    return sine;
}

double same_cos(double x)
{
    double sine, cosine;
    same_sin_cos(x, &sine, &cosine);
    return cosine;
}

/* Arc tangent of a number that is not negative. */
static double positive_atan(double x)
{
    static const double high[4] = {4.63647609000806093515e-01, 7.85398163397448278999e-01, 9.82793723247329054082e-01,
                                   1.57079632679489655800e+00};
    static const double low[4] = {2.26987774529616870924e-17, 3.06161699786838301793e-17, 1.39033110312309984516e-17,
                                  6.12323399573676603587e-17};
    int about = -1;
    if (x >= 2.4375) {
        about = 3;
        x = -1.0 / x;
    } else if (x >= 1.1875) {
        about = 2;
        x = (x - 1.5) / (1.0 + 1.5 * x);
    } else if (x >= 0.6875) {
        about = 1;
        x = (x - 1.0) / (x + 1.0);
    } else if (x >= 0.4375) {
        about = 0;
        x = (2.0 * x - 1.0) / (2.0 + x);
    }
    double z = x * x, w = z * z;
    double odd = z * (3.33333333333329318027e-01 +
                      w * (1.42857142725034663711e-01 +
                           w * (9.09088713343650656196e-02 +
                                w * (6.66107313738753120669e-02 +
                                     w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02)))));
    double even = w * (-1.99999999998764832476e-01 +
                       w * (-1.11111104054623557880e-01 +
                            w * (-7.69187620504482999495e-02 +
                                 w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02))));
    if (about < 0)
        return x - x * (odd + even);
    return high[about] - ((x * (odd + even) - low[about]) - x);
}

/* Angle from the x axis to a point. */
double same_atan2(double y, double x)
{
    if (isnan(x) || isnan(y))
        return NAN;
    double rise = fabs(y), run = fabs(x), angle;
    if (run == 0.0 && rise > 0.0)
        return y < 0.0 ? -HALF_PI_HIGH : HALF_PI_HIGH; /* to the last bit, for zeros of either sign */
    if (rise == 0.0)
        angle = 0.0;
    else if (isinf(rise) && isinf(run))
        angle = HALF_PI_HIGH / 2;
    else
        angle = positive_atan(rise / run);
    if (signbit(x))
        angle = PI_HIGH - (angle - PI_LOW);
    return signbit(y) ? -angle : angle;
}

/* (asin(x) - x) / x, from z = x * x, for x up to 0.5. */
static double asin_ratio(double z)
{
    double above = z * (1.66666666666666657415e-01 +
                        z * (-3.25565818622400915405e-01 +
                             z * (2.01212532134862925881e-01 +
                                  z * (-4.00555345006794114027e-02 +
                                       z * (7.91534994289814532176e-04 + z * 3.47933107596021167570e-05)))));
    double below = 1.0 + z * (-2.40339491173441421878e+00 +
                              z * (2.02094576023350569471e+00 +
                                   z * (-6.88283971605453293030e-01 + z * 7.70381505559019352791e-02)));
    return above / below;
}

double same_asin(double x)
{
    double size = fabs(x);
    if (!(size <= 1.0))
        return NAN;
    if (size < 0.5)
        return x + x * asin_ratio(x * x);
    double z = (1.0 - size) * 0.5, root = sqrt(z), ratio = asin_ratio(z), angle;
    if (size >= 0.975) {
        angle = HALF_PI_HIGH - (2.0 * (root + root * ratio) - HALF_PI_LOW);
    } else {
        double head = upper_half(root), tail = (z - head * head) / (root + head);
        double p = 2.0 * root * ratio - (HALF_PI_LOW - 2.0 * tail);
        angle = HALF_PI_HIGH / 2 - (p - (HALF_PI_HIGH / 2 - 2.0 * head));
    }
    return x < 0 ? -angle : angle;
}

double same_acos(double x)
{
    if (!(fabs(x) <= 1.0))
        return NAN;
    if (fabs(x) < 0.5)
        return HALF_PI_HIGH - (x - (HALF_PI_LOW - x * asin_ratio(x * x)));
    double z = (1.0 - fabs(x)) * 0.5, root = sqrt(z), ratio = asin_ratio(z);
    if (x < 0)
        return PI_HIGH - 2.0 * (root + (root * ratio - HALF_PI_LOW));
    if (z == 0.0)
        return 0.0;
    double head = upper_half(root), tail = (z - head * head) / (root + head);
    return 2.0 * (head + (root * ratio + tail));
}

double same_exp(double x)
{
    if (isnan(x))
        return x;
    if (x > 7.09782712893383973096e+02)
        return INFINITY;
    if (x < -7.45133219101941108420e+02)
        return 0.0;
    double count = floor(x * 1.44269504088896338700e+00 + 0.5);
    double high = x - count * LN2_HIGH, low = count * LN2_LOW, r = high - low, t = r * r;
    double c = r - t * (1.66666666666666019037e-01 +
                        t * (-2.77777777770155933842e-03 +
                             t * (6.61375632143793436117e-05 +
                                  t * (-1.65339022054652515390e-06 + t * 4.13813679705723846039e-08))));
    double y = 1.0 - ((low - (r * c) / (2.0 - c)) - high);
    int64_t exponent = (int64_t)count, first = exponent / 2;
    /* in two steps, as neither 2^1024 nor 2^-1074 is a normal number */
    return y * power_of_2(first) * power_of_2(exponent - first);
}

double same_log(double x)
{
    if (isnan(x) || x < 0)
        return NAN;
    if (x == 0.0)
        return -INFINITY;
    if (isinf(x))
        return x;
    int64_t exponent = -1023;
    if (exponent_of(x) == 0) {
        x *= 0x1p54;
        exponent -= 54;
    }
    exponent += exponent_of(x);
    double mantissa = from_bits((bits_of(x) & UINT64_C(0xFFFFFFFFFFFFF)) | UINT64_C(0x3FF) << 52);
    if (mantissa > 1.41421356237309504880) {
        mantissa *= 0.5;
        exponent++;
    }
    double f = mantissa - 1.0, s = f / (2.0 + f), z = s * s, w = z * z, count = (double)exponent;
    double even = w * (3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
    double odd = z * (6.666666666666735130e-01 +
                      w * (2.857142874366239149e-01 +
                           w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
    double half = 0.5 * f * f;
    return count * LN2_HIGH - ((half - (s * (half + (even + odd)) + count * LN2_LOW)) - f);
}

double same_pow(double base, double exponent) { return same_exp(exponent * same_log(base)); }

/* Evaluate a function by its number in garage2usd.native.elementary; `y` is the second argument of atan2, hypot and pow. */
FROM_PYTHON
double elementary(int64_t function, double x, double y)
{
    double sine, cosine;
    switch (function) {
    case 0: return same_sin(x);
    case 1: return same_cos(x);
    case 2: same_sin_cos(x, &sine, &cosine); return sine / cosine;
    case 3: return same_asin(x);
    case 4: return same_acos(x);
    case 5: return same_atan2(x, 1.0);
    case 6: return same_exp(x);
    case 7: return same_log(x);
    case 8: return same_atan2(x, y);
    case 9: return same_hypot(x, y);
    default: return same_pow(x, y);
    }
}

/* Evaluate a function of many numbers. */
FROM_PYTHON
void write_elementary(int64_t function, const double *firsts, const double *seconds, double *results, int64_t count)
{
    for (int64_t at = 0; at < count; at++)
        results[at] = elementary(function, firsts[at], seconds[at]);
}

/* Write the sines and cosines of many angles, in turn. */
FROM_PYTHON
void write_turns(const double *angles, double *results, int64_t count)
{
    for (int64_t at = 0; at < count; at++)
        same_sin_cos(angles[at], &results[2 * at + 1], &results[2 * at]);
}
