/* Between the program and the OpenCL loader (LD_PRELOAD): counts calls and fails the one that SPECTRAD_FAULT_AT names, counted from 1
 * (with SPECTRAD_FAULT_ON all after it too, as a lost device does), with the error SPECTRAD_FAULT_CODE. SPECTRAD_FAULT_LOG gets
 * one line a call: its function's name. */
#define _GNU_SOURCE
#define CL_TARGET_OPENCL_VERSION 120
#define CL_USE_DEPRECATED_OPENCL_1_2_APIS
#include <CL/cl.h>
#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static long calls;

static long number(const char* name, long otherwise) {
    const char* text = getenv(name);
    return text && *text ? atol(text) : otherwise;
}

/* The error that this call is to fail with, or 0. */
static cl_int fault(const char* function) {
    pthread_mutex_lock(&mutex);
    const long call = ++calls;
    const char* log = getenv("SPECTRAD_FAULT_LOG");
    if (log && *log) {
        FILE* file = fopen(log, "a");
        if (file) {
            fprintf(file, "%s\n", function);
            fclose(file);
        }
    }
    pthread_mutex_unlock(&mutex);
    const long at = number("SPECTRAD_FAULT_AT", 0);
    const int fails = at > 0 && (call == at || (call > at && number("SPECTRAD_FAULT_ON", 0)));
    return fails ? (cl_int)number("SPECTRAD_FAULT_CODE", CL_OUT_OF_RESOURCES) : CL_SUCCESS;
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))
/* Functions that return their error. */
#define STATUS(name, parameters, arguments)      \
    cl_int name parameters {                     \
        const cl_int failed = fault(#name);      \
        return failed ? failed : NEXT(name) arguments; \
    }
/* Functions that return an object, their error by the pointer `e`. */
#define OBJECT(type, name, parameters, arguments) \
    type name parameters {                        \
        const cl_int failed = fault(#name);       \
        if (!failed) return NEXT(name) arguments; \
        if (e) *e = failed;                       \
        return NULL;                              \
    }

typedef void(CL_CALLBACK* context_notice)(const char*, const void*, size_t, void*);
typedef void(CL_CALLBACK* program_notice)(cl_program, void*);

STATUS(clGetPlatformIDs, (cl_uint a, cl_platform_id* b, cl_uint* c), (a, b, c))
STATUS(clGetPlatformInfo, (cl_platform_id a, cl_platform_info b, size_t c, void* d, size_t* f), (a, b, c, d, f))
STATUS(clGetDeviceIDs, (cl_platform_id a, cl_device_type b, cl_uint c, cl_device_id* d, cl_uint* f), (a, b, c, d, f))
STATUS(clGetDeviceInfo, (cl_device_id a, cl_device_info b, size_t c, void* d, size_t* f), (a, b, c, d, f))
STATUS(clGetKernelArgInfo, (cl_kernel a, cl_uint b, cl_kernel_arg_info c, size_t d, void* f, size_t* g), (a, b, c, d, f, g))
STATUS(clGetKernelInfo, (cl_kernel a, cl_kernel_info b, size_t c, void* d, size_t* f), (a, b, c, d, f))
STATUS(clGetProgramBuildInfo, (cl_program a, cl_device_id b, cl_program_build_info c, size_t d, void* f, size_t* g), (a, b, c, d, f, g))
STATUS(clGetProgramInfo, (cl_program a, cl_program_info b, size_t c, void* d, size_t* f), (a, b, c, d, f))
STATUS(clBuildProgram, (cl_program a, cl_uint b, const cl_device_id* c, const char* d, program_notice f, void* g), (a, b, c, d, f, g))
STATUS(clCreateKernelsInProgram, (cl_program a, cl_uint b, cl_kernel* c, cl_uint* d), (a, b, c, d))
STATUS(clSetKernelArg, (cl_kernel a, cl_uint b, size_t c, const void* d), (a, b, c, d))
STATUS(clEnqueueFillBuffer,
       (cl_command_queue a, cl_mem b, const void* c, size_t d, size_t f, size_t g, cl_uint h, const cl_event* i, cl_event* j),
       (a, b, c, d, f, g, h, i, j))
STATUS(clEnqueueNDRangeKernel,
       (cl_command_queue a, cl_kernel b, cl_uint c, const size_t* d, const size_t* f, const size_t* g, cl_uint h, const cl_event* i, cl_event* j),
       (a, b, c, d, f, g, h, i, j))
STATUS(clEnqueueReadBuffer, (cl_command_queue a, cl_mem b, cl_bool c, size_t d, size_t f, void* g, cl_uint h, const cl_event* i, cl_event* j),
       (a, b, c, d, f, g, h, i, j))
STATUS(clEnqueueWriteBuffer,
       (cl_command_queue a, cl_mem b, cl_bool c, size_t d, size_t f, const void* g, cl_uint h, const cl_event* i, cl_event* j),
       (a, b, c, d, f, g, h, i, j))
STATUS(clEnqueueUnmapMemObject, (cl_command_queue a, cl_mem b, void* c, cl_uint d, const cl_event* f, cl_event* g), (a, b, c, d, f, g))
STATUS(clRetainCommandQueue, (cl_command_queue a), (a))
STATUS(clRetainContext, (cl_context a), (a))
STATUS(clRetainDevice, (cl_device_id a), (a))
STATUS(clRetainKernel, (cl_kernel a), (a))
STATUS(clRetainMemObject, (cl_mem a), (a))
STATUS(clRetainProgram, (cl_program a), (a))
STATUS(clReleaseCommandQueue, (cl_command_queue a), (a))
STATUS(clReleaseContext, (cl_context a), (a))
STATUS(clReleaseDevice, (cl_device_id a), (a))
STATUS(clReleaseKernel, (cl_kernel a), (a))
STATUS(clReleaseMemObject, (cl_mem a), (a))
STATUS(clReleaseProgram, (cl_program a), (a))
OBJECT(cl_mem, clCreateBuffer, (cl_context a, cl_mem_flags b, size_t c, void* d, cl_int* e), (a, b, c, d, e))
OBJECT(cl_command_queue, clCreateCommandQueue, (cl_context a, cl_device_id b, cl_command_queue_properties c, cl_int* e), (a, b, c, e))
OBJECT(cl_context, clCreateContext,
       (const cl_context_properties* a, cl_uint b, const cl_device_id* c, context_notice d, void* f, cl_int* e), (a, b, c, d, f, e))
OBJECT(cl_kernel, clCreateKernel, (cl_program a, const char* b, cl_int* e), (a, b, e))
OBJECT(cl_program, clCreateProgramWithBinary,
       (cl_context a, cl_uint b, const cl_device_id* c, const size_t* d, const unsigned char** f, cl_int* g, cl_int* e),
       (a, b, c, d, f, g, e))
OBJECT(cl_program, clCreateProgramWithSource, (cl_context a, cl_uint b, const char** c, const size_t* d, cl_int* e), (a, b, c, d, e))
OBJECT(void*, clEnqueueMapBuffer,
       (cl_command_queue a, cl_mem b, cl_bool c, cl_map_flags d, size_t f, size_t g, cl_uint h, const cl_event* i, cl_event* j, cl_int* e),
       (a, b, c, d, f, g, h, i, j, e))
