#pragma once
// SIMD packs: one kernel is written as template<class V> and runs with V = double (the oracle) or with the
// widest pack of the instruction set its file is compiled for. Nodes are stored as x, y, z one behind the
// other; a pack of nodes is loaded and stored through transposes of four numbers per lane.
//
// Everything that is compiled per instruction set lives in an inline namespace named after it, so the linker
// can never exchange an AVX function for a baseline one.
#include <cstdint>
#include <experimental/simd>

#if defined(__AVX2__) || defined(__AVX512F__) || defined(__SSE2__)
#include <immintrin.h>
#endif

#if defined(__AVX512F__)
#define FISSURA_ISA isa_v4
#elif defined(__AVX2__)
#define FISSURA_ISA isa_v3
#elif defined(__SSE4_2__)
#define FISSURA_ISA isa_v2
#else
#define FISSURA_ISA isa_v1
#endif

namespace fissura::core {
inline namespace FISSURA_ISA {

namespace stdx = std::experimental;
using Pack = stdx::native_simd<double>;

template <class V> inline constexpr int lanes = V::size();
template <> inline constexpr int lanes<double> = 1;

/// For __builtin_prefetch: the line will be written, so that no other processor should keep it.
inline constexpr int to_write = 1;

template <class V> inline V load(double const* p) {
  if constexpr (std::is_same_v<V, double>)
    return *p;
  else
    return V(p, stdx::element_aligned);
}
template <class V> inline V load(float const* p) {
  if constexpr (std::is_same_v<V, double>)
    return *p;
  else
    return V(p, stdx::element_aligned);
}
template <class V> inline V load(std::uint8_t const* p) {
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

template <class V> inline double sum_lanes(V v) {
  if constexpr (std::is_same_v<V, double>)
    return v;
  else {
    double s = 0;
    for (int i = 0; i < lanes<V>; ++i) s += v[i];
    return s;
  }
}

template <class V> inline V square_root(V a) {
  using std::sqrt;
  using stdx::sqrt;
  return sqrt(a);
}
/// 1/sqrt(a) for a > 0, to the last digit or two.
template <class V> inline V inverse_root(V a) {
#if defined(__AVX512F__)
  if constexpr (lanes<V> == 8) {
    V r(_mm512_rsqrt14_pd(static_cast<__m512d>(a)));
    V const half = V(0.5) * a;
    for (int i = 0; i < 2; ++i) r = r * (V(1.5) - half * r * r); // Newton: 14, 28, 56 bits
    return r;
  }
#endif
  return V(1.0) / square_root(a);
}
template <class V> inline V absolute(V a) {
  using std::abs;
  using stdx::abs;
  return abs(a);
}
/// a where the condition holds, b elsewhere.
template <class V, class M> inline V choose(M condition, V a, V b) {
  if constexpr (std::is_same_v<V, double>) return condition ? a : b;
#if defined(__AVX512F__) && defined(__clang__)
  // Compiled by clang, libstdc++ 12 takes one choice for all lanes here: a defect of its _S_blend_avx512.
  else if constexpr (lanes<V> == 8)
    return V(_mm512_mask_blend_pd(static_cast<__mmask8>(condition.__to_bitset().to_ulong()),
                                  static_cast<__m512d>(b), static_cast<__m512d>(a)));
#endif
  else {
    stdx::where(condition, b) = a;
    return b;
  }
}
template <class V> inline V larger(V a, V b) {
  return choose(a > b, a, b);
}
template <class V> inline V smaller(V a, V b) {
  return choose(a < b, a, b);
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

/// Four doubles per lane, at base + index[0], base + index[1], ... (indices in doubles), into out[0..3].
template <class V> inline void load_fours(double const* base, int const* index, V (&out)[4]) {
  if constexpr (std::is_same_v<V, double>) {
    double const* p = base + index[0];
    out[0] = p[0], out[1] = p[1], out[2] = p[2], out[3] = p[3];
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
    out[0] = V(_mm512_permutex2var_pd(t0, even, t2)), out[1] = V(_mm512_permutex2var_pd(t1, even, t3));
    out[2] = V(_mm512_permutex2var_pd(t0, odd, t2)), out[3] = V(_mm512_permutex2var_pd(t1, odd, t3));
#elif defined(__AVX2__)
    __m256d const a = _mm256_loadu_pd(base + index[0]), b = _mm256_loadu_pd(base + index[1]);
    __m256d const c = _mm256_loadu_pd(base + index[2]), d = _mm256_loadu_pd(base + index[3]);
    __m256d const t0 = _mm256_unpacklo_pd(a, b), t1 = _mm256_unpackhi_pd(a, b);
    __m256d const t2 = _mm256_unpacklo_pd(c, d), t3 = _mm256_unpackhi_pd(c, d);
    out[0] = V(_mm256_permute2f128_pd(t0, t2, 0x20)), out[1] = V(_mm256_permute2f128_pd(t1, t3, 0x20));
    out[2] = V(_mm256_permute2f128_pd(t0, t2, 0x31)), out[3] = V(_mm256_permute2f128_pd(t1, t3, 0x31));
#else
    for (int i = 0; i < lanes<V>; ++i)
      for (int c = 0; c < 4; ++c) out[c][i] = base[index[i] + c];
#endif
  }
}

/// The opposite of load_fours.
template <class V> inline void store_fours(double* base, int const* index, V const (&in)[4]) {
  if constexpr (std::is_same_v<V, double>) {
    double* p = base + index[0];
    p[0] = in[0], p[1] = in[1], p[2] = in[2], p[3] = in[3];
  } else {
#if defined(__AVX512F__)
    __m512d const x = static_cast<__m512d>(in[0]), y = static_cast<__m512d>(in[1]);
    __m512d const z = static_cast<__m512d>(in[2]), w = static_cast<__m512d>(in[3]);
    __m512d const t0 = _mm512_unpacklo_pd(x, y), t1 = _mm512_unpackhi_pd(x, y);
    __m512d const t2 = _mm512_unpacklo_pd(z, w), t3 = _mm512_unpackhi_pd(z, w);
    __m512i const even = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13),
                  odd = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    auto put = [&](int i, __m512d a) {
      _mm256_storeu_pd(base + index[i], _mm512_castpd512_pd256(a));
      _mm256_storeu_pd(base + index[i + 4], _mm512_extractf64x4_pd(a, 1));
    };
    put(0, _mm512_permutex2var_pd(t0, even, t2)), put(2, _mm512_permutex2var_pd(t0, odd, t2));
    put(1, _mm512_permutex2var_pd(t1, even, t3)), put(3, _mm512_permutex2var_pd(t1, odd, t3));
#elif defined(__AVX2__)
    __m256d const x = static_cast<__m256d>(in[0]), y = static_cast<__m256d>(in[1]);
    __m256d const z = static_cast<__m256d>(in[2]), w = static_cast<__m256d>(in[3]);
    __m256d const t0 = _mm256_unpacklo_pd(x, y), t1 = _mm256_unpackhi_pd(x, y);
    __m256d const t2 = _mm256_unpacklo_pd(z, w), t3 = _mm256_unpackhi_pd(z, w);
    _mm256_storeu_pd(base + index[0], _mm256_permute2f128_pd(t0, t2, 0x20));
    _mm256_storeu_pd(base + index[1], _mm256_permute2f128_pd(t1, t3, 0x20));
    _mm256_storeu_pd(base + index[2], _mm256_permute2f128_pd(t0, t2, 0x31));
    _mm256_storeu_pd(base + index[3], _mm256_permute2f128_pd(t1, t3, 0x31));
#else
    for (int i = 0; i < lanes<V>; ++i)
      for (int c = 0; c < 4; ++c) base[index[i] + c] = in[c][i];
#endif
  }
}

/// The vectors at base + index[0], base + index[1], ... (indices in doubles). Reads one number beyond each.
template <class V> inline Vec<V> load_vectors(double const* base, int const* index) {
  V node[4];
  load_fours(base, index, node);
  return {node[0], node[1], node[2]};
}

/// Three vectors per lane, nine doubles without a gap, at base + index[0], base + index[1], ...
template <class V> inline void store_three(double* base, int const* index, Vec<V> const (&v)[3]) {
  store_fours(base, index, {v[0].x, v[0].y, v[0].z, v[1].x});
  store_fours(base + 4, index, {v[1].y, v[1].z, v[2].x, v[2].y});
  store_fours(base + 5, index, {v[1].z, v[2].x, v[2].y, v[2].z}); // three of them once more, for the ninth
}

/// The four nodes of the tets that lie one behind the other from `base` on, one per lane.
template <class V> inline void load_tets(double const* base, Vec<V> (&node)[4]) {
  int index[lanes<V>];
  for (int i = 0; i < lanes<V>; ++i) index[i] = 12 * i;
  V a[4], b[4], c[4];
  load_fours(base, index, a), load_fours(base + 4, index, b), load_fours(base + 8, index, c);
  node[0] = {a[0], a[1], a[2]}, node[1] = {a[3], b[0], b[1]};
  node[2] = {b[2], b[3], c[0]}, node[3] = {c[1], c[2], c[3]};
}

/// The opposite of load_tets.
template <class V> inline void store_tets(double* base, Vec<V> const (&node)[4]) {
  int index[lanes<V>];
  for (int i = 0; i < lanes<V>; ++i) index[i] = 12 * i;
  store_fours(base, index, {node[0].x, node[0].y, node[0].z, node[1].x});
  store_fours(base + 4, index, {node[1].y, node[1].z, node[2].x, node[2].y});
  store_fours(base + 8, index, {node[2].z, node[3].x, node[3].y, node[3].z});
}

} // namespace FISSURA_ISA
} // namespace fissura::core
