#pragma once
// SIMD packs: one kernel is written as template<class V> and runs with V = double (the oracle) or with the
// widest pack of the instruction set its file is compiled for. Nodes are stored as x, y, z, 0 (one aligned
// load each); a pack of nodes is loaded and stored through transposes.
//
// Everything that is compiled per instruction set lives in an inline namespace named after it, so the linker
// can never exchange an AVX function for a baseline one.
#include <experimental/simd>

#if defined(__AVX2__) || defined(__AVX512F__) || defined(__SSE2__)
#include <immintrin.h>
#endif

#if defined(__AVX512F__)
#define FISSURA_ISA isa_v4
#elif defined(__AVX2__)
#define FISSURA_ISA isa_v3
#else
#define FISSURA_ISA isa_v2
#endif

namespace fissura::core {
inline namespace FISSURA_ISA {

namespace stdx = std::experimental;
using Pack = stdx::native_simd<double>;

template <class V> inline constexpr int lanes = V::size();
template <> inline constexpr int lanes<double> = 1;

template <class V> inline V load(double const* p) {
  if constexpr (std::is_same_v<V, double>)
    return *p;
  else
    return V(p, stdx::element_aligned);
}
template <class V> inline void store(double* p, V v) {
  if constexpr (std::is_same_v<V, double>)
    *p = v;
  else
    v.copy_to(p, stdx::element_aligned);
}

/// Vectors whose components are packs.
template <class V> struct Vec { V x, y, z; };
template <class V> inline Vec<V> operator+(Vec<V> a, Vec<V> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V> inline Vec<V> operator-(Vec<V> a, Vec<V> b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V> inline Vec<V> operator*(V s, Vec<V> a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class V> inline V dot(Vec<V> a, Vec<V> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V> inline Vec<V> cross(Vec<V> a, Vec<V> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class V> inline V square_root(V a) {
  using std::sqrt;
  using stdx::sqrt;
  return sqrt(a);
}
template <class V> inline V absolute(V a) {
  using std::abs;
  using stdx::abs;
  return abs(a);
}
/// a where the condition holds, b elsewhere.
template <class V, class M> inline V choose(M condition, V a, V b) {
  if constexpr (std::is_same_v<V, double>)
    return condition ? a : b;
  else {
    stdx::where(condition, b) = a;
    return b;
  }
}
template <class M> inline bool any(M m) {
  if constexpr (std::is_same_v<M, bool>)
    return m;
  else
    return stdx::any_of(m);
}
template <class M> inline bool lane(M m, int i) {
  if constexpr (std::is_same_v<M, bool>)
    return m;
  else
    return m[i];
}

/// The nodes at base + index[0], base + index[1], ... (indices in doubles, multiples of 4).
template <class V> inline Vec<V> load_nodes(double const* base, int const* index) {
  if constexpr (std::is_same_v<V, double>) {
    double const* p = base + index[0];
    return {p[0], p[1], p[2]};
  } else {
#if defined(__AVX512F__)
    auto two = [&](int i) {
      return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(base + index[i])),
                                _mm256_loadu_pd(base + index[i + 4]), 1);
    };
    __m512d const r0 = two(0), r1 = two(1), r2 = two(2), r3 = two(3);
    __m512d const t0 = _mm512_unpacklo_pd(r0, r1), t1 = _mm512_unpackhi_pd(r0, r1);
    __m512d const t2 = _mm512_unpacklo_pd(r2, r3), t3 = _mm512_unpackhi_pd(r2, r3);
    __m512i const even = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13),
                  odd = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    return {V(_mm512_permutex2var_pd(t0, even, t2)), V(_mm512_permutex2var_pd(t1, even, t3)),
            V(_mm512_permutex2var_pd(t0, odd, t2))};
#elif defined(__AVX2__)
    __m256d const a = _mm256_loadu_pd(base + index[0]), b = _mm256_loadu_pd(base + index[1]);
    __m256d const c = _mm256_loadu_pd(base + index[2]), d = _mm256_loadu_pd(base + index[3]);
    __m256d const t0 = _mm256_unpacklo_pd(a, b), t1 = _mm256_unpackhi_pd(a, b);
    __m256d const t2 = _mm256_unpacklo_pd(c, d), t3 = _mm256_unpackhi_pd(c, d);
    return {V(_mm256_permute2f128_pd(t0, t2, 0x20)), V(_mm256_permute2f128_pd(t1, t3, 0x20)),
            V(_mm256_permute2f128_pd(t0, t2, 0x31))};
#else
    Vec<V> r;
    for (int i = 0; i < lanes<V>; ++i) {
      r.x[i] = base[index[i]];
      r.y[i] = base[index[i] + 1];
      r.z[i] = base[index[i] + 2];
    }
    return r;
#endif
  }
}

/// Stores lane i at p + i*stride as x, y, z, 0.
template <class V> inline void store_nodes(double* p, std::ptrdiff_t stride, Vec<V> v) {
  if constexpr (std::is_same_v<V, double>) {
    p[0] = v.x, p[1] = v.y, p[2] = v.z, p[3] = 0;
  } else {
#if defined(__AVX512F__)
    __m512d const x = static_cast<__m512d>(v.x), y = static_cast<__m512d>(v.y), z = static_cast<__m512d>(v.z);
    __m512d const o = _mm512_setzero_pd();
    __m512d const t0 = _mm512_unpacklo_pd(x, y), t1 = _mm512_unpackhi_pd(x, y);
    __m512d const t2 = _mm512_unpacklo_pd(z, o), t3 = _mm512_unpackhi_pd(z, o);
    __m512i const even = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13),
                  odd = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    auto put = [&](int i, __m512d a) {
      _mm256_storeu_pd(p + i * stride, _mm512_castpd512_pd256(a));
      _mm256_storeu_pd(p + (i + 4) * stride, _mm512_extractf64x4_pd(a, 1));
    };
    put(0, _mm512_permutex2var_pd(t0, even, t2));
    put(2, _mm512_permutex2var_pd(t0, odd, t2));
    put(1, _mm512_permutex2var_pd(t1, even, t3));
    put(3, _mm512_permutex2var_pd(t1, odd, t3));
#elif defined(__AVX2__)
    __m256d const x = static_cast<__m256d>(v.x), y = static_cast<__m256d>(v.y), z = static_cast<__m256d>(v.z);
    __m256d const o = _mm256_setzero_pd();
    __m256d const t0 = _mm256_unpacklo_pd(x, y), t1 = _mm256_unpackhi_pd(x, y);
    __m256d const t2 = _mm256_unpacklo_pd(z, o), t3 = _mm256_unpackhi_pd(z, o);
    _mm256_storeu_pd(p, _mm256_permute2f128_pd(t0, t2, 0x20));
    _mm256_storeu_pd(p + stride, _mm256_permute2f128_pd(t1, t3, 0x20));
    _mm256_storeu_pd(p + 2 * stride, _mm256_permute2f128_pd(t0, t2, 0x31));
    _mm256_storeu_pd(p + 3 * stride, _mm256_permute2f128_pd(t1, t3, 0x31));
#else
    for (int i = 0; i < lanes<V>; ++i) {
      double* const q = p + i * stride;
      q[0] = v.x[i], q[1] = v.y[i], q[2] = v.z[i], q[3] = 0;
    }
#endif
  }
}

} // namespace FISSURA_ISA
} // namespace fissura::core
