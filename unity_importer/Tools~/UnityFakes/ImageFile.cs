using System;
using System.IO;
using System.IO.Compression;
using System.Text;

namespace UnityEngine
{
    /// <summary>Sizes of PNG and JPEG files, and the pixels of PNG files.</summary>
    static class ImageFile
    {
        static readonly byte[] Signature = { 0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10 };

        static bool IsPng(byte[] data)
        {
            for (int i = 0; i < Signature.Length; i++)
            {
                if (data.Length <= i || data[i] != Signature[i]) { return false; }
            }
            return true;
        }

        static bool IsJpeg(byte[] data)
        {
            return data.Length > 4 && data[0] == 0xff && data[1] == 0xd8;
        }

        public static bool IsImage(byte[] data)
        {
            return IsPng(data) || IsJpeg(data);
        }

        static int Big(byte[] data, int place, int count)
        {
            int number = 0;
            for (int i = 0; i < count; i++) { number = number << 8 | data[place + i]; }
            return number;
        }

        public static void ReadHeader(byte[] data, out int width, out int height, out bool hasAlpha)
        {
            hasAlpha = false;
            if (IsPng(data))
            {
                width = Big(data, 16, 4);
                height = Big(data, 20, 4);
                hasAlpha = data[25] >= 4 || FindChunk(data, "tRNS") >= 0;
                return;
            }
            for (int place = 2; place + 9 < data.Length; place += 2 + Big(data, place + 2, 2))
            {
                int marker = data[place + 1];
                if (marker < 0xc0 || marker > 0xcf || marker == 0xc4 || marker == 0xc8 || marker == 0xcc) { continue; }
                height = Big(data, place + 5, 2);
                width = Big(data, place + 7, 2);
                return;
            }
            throw new InvalidDataException("the JPEG has no size");
        }

        static int FindChunk(byte[] data, string name)
        {
            for (int place = 8; place + 8 <= data.Length; place += 12 + Big(data, place, 4))
            {
                if (Encoding.ASCII.GetString(data, place + 4, 4) == name) { return place + 8; }
            }
            return -1;
        }

        /// <summary>Row by row from below, as Unity has them.</summary>
        public static Color32[] Decode(byte[] data)
        {
            if (!IsPng(data)) { throw new NotSupportedException("pixels are read here of PNG files only"); }
            int width = Big(data, 16, 4), height = Big(data, 20, 4), bits = data[24], kind = data[25];
            int channels = kind == 0 || kind == 3 ? 1 : kind == 2 ? 3 : kind == 4 ? 2 : 4;
            if (bits > 8 || data[28] != 0)
            {
                throw new NotSupportedException("only PNG files of at most 8 bits without interlacing are read here");
            }
            int stride = (width * channels * bits + 7) / 8;
            byte[] rows = Inflated(data, (stride + 1) * height);
            int colors = FindChunk(data, "PLTE"), alphas = FindChunk(data, "tRNS"), alphaCount = alphas < 0 ? 0
                : Big(data, alphas - 8, 4);
            var pixels = new Color32[width * height];
            for (int row = 0; row < height; row++)
            {
                int start = row * (stride + 1) + 1;
                Unfilter(rows, start, stride, channels, rows[start - 1], row > 0);
                int into = (height - 1 - row) * width;
                for (int column = 0; column < width; column++)
                {
                    int at = start + column * channels * bits / 8;
                    // several of fewer bits share a byte, from its highest bits on
                    int most = (1 << bits) - 1, value = rows[at] >> (8 - bits - column * bits % 8) & most;
                    byte first = (byte)(kind == 3 ? value : value * 255 / most);
                    if (kind == 3)
                    {
                        byte alpha = first < alphaCount ? data[alphas + first] : (byte)255;
                        pixels[into + column] = new Color32(data[colors + 3 * first], data[colors + 3 * first + 1],
                            data[colors + 3 * first + 2], alpha);
                    }
                    else if (channels <= 2)
                    {
                        pixels[into + column] = new Color32(first, first, first, channels == 2 ? rows[at + 1]
                            : (byte)255);
                    }
                    else
                    {
                        pixels[into + column] = new Color32(first, rows[at + 1], rows[at + 2], channels == 4
                            ? rows[at + 3] : (byte)255);
                    }
                }
            }
            return pixels;
        }

        static byte[] Inflated(byte[] data, int size)
        {
            var packed = new MemoryStream();
            for (int place = 8; place + 8 <= data.Length; place += 12 + Big(data, place, 4))
            {
                if (Encoding.ASCII.GetString(data, place + 4, 4) == "IDAT")
                {
                    packed.Write(data, place + 8, Big(data, place, 4));
                }
            }
            // two bytes of zlib's header
            packed.Position = 2;
            var bytes = new byte[size];
            using (var stream = new DeflateStream(packed, CompressionMode.Decompress))
            {
                for (int got = 0; got < size;)
                {
                    int count = stream.Read(bytes, got, size - got);
                    if (count == 0) { throw new InvalidDataException("the PNG is cut off"); }
                    got += count;
                }
            }
            return bytes;
        }

        static void Unfilter(byte[] rows, int start, int stride, int back, int filter, bool hasAbove)
        {
            for (int i = 0; i < stride && filter != 0; i++)
            {
                int at = start + i;
                int left = i >= back ? rows[at - back] : 0, above = hasAbove ? rows[at - stride - 1] : 0;
                int corner = i >= back && hasAbove ? rows[at - stride - 1 - back] : 0;
                int guess = filter == 1 ? left : filter == 2 ? above : filter == 3 ? (left + above) / 2
                    : Paeth(left, above, corner);
                rows[at] = (byte)(rows[at] + guess);
            }
        }

        static int Paeth(int left, int above, int corner)
        {
            int guess = left + above - corner, a = Math.Abs(guess - left), b = Math.Abs(guess - above),
                c = Math.Abs(guess - corner);
            return a <= b && a <= c ? left : b <= c ? above : corner;
        }
    }
}
