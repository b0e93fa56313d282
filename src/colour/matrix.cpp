#include "colour/colour.h"

namespace spectrad {

Triple operator*(const Matrix3& m, const Triple& v) {
    Triple r;
    for (size_t i = 0; i < 3; ++i)
        r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return r;
}

Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
    Matrix3 r;
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
            r[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    return r;
}

static Triple cross(const Triple& a, const Triple& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double determinant(const Matrix3& m) {
    const Triple c = cross(m[1], m[2]);
    return m[0][0] * c[0] + m[0][1] * c[1] + m[0][2] * c[2];
}

Matrix3 inverse(const Matrix3& m) {
    // Columns of the inverse are the cross products of the rows, over the determinant.
    const std::array<Triple, 3> column{cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
    const double scale = 1 / determinant(m);
    Matrix3 r;
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
            r[i][j] = column[j][i] * scale;
    return r;
}

Matrix3 diagonal(const Triple& d) {
    return {{{d[0], 0, 0}, {0, d[1], 0}, {0, 0, d[2]}}};
}

}  // namespace spectrad
