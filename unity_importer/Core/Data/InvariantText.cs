using System.Globalization;

namespace Garage.Usd
{
    /// <summary>Numbers as text that is the same in all countries: for names, keys and warnings.</summary>
    public static class InvariantText
    {
        /// <summary>The numbers with a space between them, each as exact as it is.</summary>
        public static string Of(params double[] numbers)
        {
            var texts = new string[numbers.Length];
            for (int i = 0; i < texts.Length; i++) { texts[i] = numbers[i].ToString("R", CultureInfo.InvariantCulture); }
            return string.Join(" ", texts);
        }
    }
}
