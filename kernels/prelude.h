/* First in every kernel file: the numeric policy, the shape of vectors, and the switches with their defaults.
 * Contraction is off and fused multiply-adds are written out, so that + - * / sqrt and fma give the same bits on every
 * conforming device as in C++. CONTRACT is for studies of what that costs. */
#ifdef CONTRACT
#pragma OPENCL FP_CONTRACT ON
#else
#pragma OPENCL FP_CONTRACT OFF
#endif
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#pragma OPENCL EXTENSION cl_khr_int64_base_atomics : enable
#pragma OPENCL EXTENSION cl_khr_int64_extended_atomics : enable

#include "types.h"

/* Lanes of a vector: 16 on CPUs, 1 on GPUs (-DVW). */
#ifndef VW
#define VW 16
#endif
/* Slots for samples in a pixel: SAMPLES of the plan rounded up to a power of two (-DSLOTS). Lanes run over [x][slot]. */
#ifndef SLOTS
#define SLOTS 16
#endif

#if VW == 16
typedef float16 vfloat;
typedef int16 vint;
typedef uint16 vuint;
typedef long16 vlong;
typedef ulong16 vulong;
typedef double16 vdouble;
#define VLOAD(p) vload16(0, p)
#define VSTORE(v, p) vstore16(v, 0, p)
#define V_INT(v) convert_int16(v)
#define V_UINT(v) convert_uint16(v)
#define V_FLOAT(v) convert_float16(v)
#define V_LONG(v) convert_long16(v)
#define V_ULONG(v) convert_ulong16(v)
#define V_DOUBLE(v) convert_double16(v)
#define AS_UINT(v) as_uint16(v)
#define AS_INT(v) as_int16(v)
#define AS_FLOAT(v) as_float16(v)
#define ANY(mask) any(mask)
#define ALL(mask) all(mask)
#elif VW == 1
typedef float vfloat;
typedef int vint;
typedef uint vuint;
typedef long vlong;
typedef ulong vulong;
typedef double vdouble;
#define VLOAD(p) (*(p))
#define VSTORE(v, p) (*(p) = (v))
#define V_INT(v) convert_int(v)
#define V_UINT(v) convert_uint(v)
#define V_FLOAT(v) convert_float(v)
#define V_LONG(v) convert_long(v)
#define V_ULONG(v) convert_ulong(v)
#define V_DOUBLE(v) convert_double(v)
#define AS_UINT(v) as_uint(v)
#define AS_INT(v) as_int(v)
#define AS_FLOAT(v) as_float(v)
#define ANY(mask) ((mask) != 0)
#define ALL(mask) ((mask) != 0)
#else
#error "VW is 1 or 16"
#endif

/* Lanes whose pattern of (pixel, slot) repeats: entries of the sample tables. */
#define PATTERN (SLOTS > VW ? SLOTS : VW)
/* Key of a sample that no triangle covers; any covered one is smaller. High word: depth, nearest smallest; low: triangle. */
#define EMPTY_KEY 0xffffffffffffffffUL
#define NO_TRIANGLE 0xffffffffu
